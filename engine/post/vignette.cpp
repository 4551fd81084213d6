#include "engine/post/vignette.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/check.h"

namespace rowland::post {

namespace {

/// cos⁴ of the angle whose tangent is given.
float cos4(float tangent) {
    const float squared_secant = 1.0F + tangent * tangent;
    return 1.0F / (squared_secant * squared_secant);
}

}  // namespace

float vignette_factor(glm::ivec2 pixel, glm::ivec2 size, const VignetteSettings& settings) {
    const glm::vec2 half_size = 0.5F * glm::vec2(size);
    const float distance = glm::length(glm::vec2(pixel) + 0.5F - half_size);
    const float radius = distance / glm::length(half_size);
    const float taste =
        1.0F - settings.strength * glm::smoothstep(settings.radius, settings.radius + settings.softness, radius);
    if (!settings.vertical_fov) return taste;
    return taste * cos4(std::tan(0.5F * *settings.vertical_fov) * distance / half_size.y);
}

void apply_vignette(std::span<glm::vec3> pixels, glm::ivec2 size, const VignetteSettings& settings) {
    require_valid(settings);
    ROWLAND_CHECK_OP(pixels.size(), ==, static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    std::size_t i = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) pixels[i++] *= vignette_factor({x, y}, size, settings);
    }
}

bool has_effect(const VignetteSettings& settings) {
    return settings.vertical_fov.has_value() || settings.strength != 0.0F;
}

void require_valid(const VignetteSettings& settings) {
    const float fov = settings.vertical_fov.value_or(1.0F);
    ROWLAND_CHECK_OP(fov, >, 0.0F);
    ROWLAND_CHECK_OP(fov, <, std::numbers::pi_v<float>);
    ROWLAND_CHECK_OP(settings.strength, >=, 0.0F);
    ROWLAND_CHECK_OP(settings.strength, <=, 1.0F);
    ROWLAND_CHECK_OP(settings.radius, >=, 0.0F);
    ROWLAND_CHECK_OP(settings.softness, >, 0.0F);
}

}  // namespace rowland::post
