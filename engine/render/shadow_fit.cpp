#include "engine/render/shadow_fit.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "engine/core/check.h"
#include "engine/render/world_bounds.h"
#include "engine/scene/tangents.h"

namespace rowland::render {

namespace {

constexpr float kMarginTexels = 4.0F;  ///< empty border at each edge, for the filter, the lift and the snapping

/// The next step of 2^¼ that is not smaller.
float in_steps(float length) {
    return std::exp2(std::ceil(4.0F * std::log2(length)) / 4.0F);
}

/// World to axes across the light (x, y) and toward it (z).
glm::mat3 light_axes(const glm::vec3& toward_light) {
    const glm::vec3 x = scene::any_perpendicular(toward_light);
    return glm::transpose(glm::mat3(x, glm::cross(toward_light, x), toward_light));
}

/// The overlap of both across the light, with the casters' depth; `seen` where they do not overlap.
scene::Bounds shadowed_region(const scene::Bounds& casters, const scene::Bounds& seen) {
    scene::Bounds region{glm::max(casters.minimum, seen.minimum), glm::min(casters.maximum, seen.maximum)};
    if (region.minimum.x > region.maximum.x || region.minimum.y > region.maximum.y) region = seen;
    region.minimum.z = casters.minimum.z;
    region.maximum.z = casters.maximum.z;
    return region;
}

}  // namespace

Sphere around_view(const scene::Camera& camera, float aspect, float far_distance) {
    const float far = in_steps(std::clamp(far_distance, camera.near_plane * 1.01F, camera.far_plane));
    const float near = camera.near_plane;
    const float half_height = std::tan(0.5F * camera.vertical_field_of_view);
    const float corner2 = half_height * half_height * (1.0F + aspect * aspect);  // (distance from the axis / depth)²
    const float depth = std::min(far, 0.5F * (near + far) * (1.0F + corner2));
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    return {camera.eye + depth * forward, std::sqrt((far - depth) * (far - depth) + corner2 * far * far)};
}

bool ShadowView::may_see(const scene::Bounds& box) const {
    const scene::Bounds clip = transformed(box, world_to_clip);
    return clip.maximum.x >= -1.0F && clip.minimum.x <= 1.0F && clip.maximum.y >= -1.0F && clip.minimum.y <= 1.0F;
}

ShadowView fit_shadow(const glm::vec3& toward_light, std::span<const scene::Bounds> casters, const Sphere& seen,
                      int size) {
    ROWLAND_CHECK(!casters.empty(), "a shadow map needs something that casts a shadow");
    ROWLAND_CHECK_OP(size, >=, 32);
    const glm::mat3 axes = light_axes(toward_light);
    scene::Bounds cast = transformed(casters.front(), glm::mat4(axes));
    for (const scene::Bounds& caster : casters.subspan(1)) {
        const scene::Bounds box = transformed(caster, glm::mat4(axes));
        cast = {glm::min(cast.minimum, box.minimum), glm::max(cast.maximum, box.maximum)};
    }
    const glm::vec3 centre = axes * seen.centre;
    const scene::Bounds region = shadowed_region(cast, {centre - seen.radius, centre + seen.radius});

    const auto texels = static_cast<float>(size);
    const glm::vec3 extent = region.maximum - region.minimum;
    const float side = in_steps(std::max({extent.x, extent.y, 1e-4F}) * texels / (texels - 2.0F * kMarginTexels));
    const float texel = side / texels;
    const glm::vec2 middle = glm::floor(0.5F * glm::vec2(region.minimum + region.maximum) / texel) * texel;
    const float slack = texel + 1e-3F * extent.z;  // surfaces that face the light lie at one depth
    const float top = region.maximum.z + slack;
    const float depth = extent.z + 2.0F * slack;

    glm::mat4 to_clip(1.0F);
    to_clip[0][0] = to_clip[1][1] = 2.0F / side;
    to_clip[2][2] = -2.0F / depth;
    to_clip[3] = glm::vec4(-2.0F * middle / side, 2.0F * top / depth - 1.0F, 1.0F);
    return {to_clip * glm::mat4(axes), texel};
}

}  // namespace rowland::render
