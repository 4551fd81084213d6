#include "engine/post/vignette.h"

#include <cmath>
#include <numbers>

#include "engine/core/check.h"

namespace rowland::post {

VignettePass::VignettePass(const gpu::ShaderLibrary& library)
    : program_(library, gpu::full_screen_pass("engine/post/shaders/vignette.frag.glsl")) {}

void VignettePass::draw(const gpu::Texture& source, const VignetteSettings& settings,
                        const gpu::Framebuffer& target) const {
    require_valid(settings);
    ROWLAND_CHECK(source.size() == target.size(), "the target of a vignette must have the source's size");
    program_.set("tan_half_fov", settings.vertical_fov ? std::tan(0.5F * *settings.vertical_fov) : 0.0F);
    program_.set("strength", settings.strength);
    program_.set("radius", settings.radius);
    program_.set("softness", settings.softness);
    program_.set("into_halves", target.holds_halves() ? 1 : 0);
    source.bind(0);
    triangle_.draw(program_, target);
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
