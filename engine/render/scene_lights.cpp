#include "engine/render/scene_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/mat3x3.hpp>
#include <utility>
#include <vector>

#include "engine/core/check.h"
#include "engine/scene/light.h"
#include "engine/scene/mesh.h"
#include "engine/scene/transform.h"

namespace rowland::render {

namespace {

scene::Bounds merged(const scene::Bounds& a, const scene::Bounds& b) {
    return {glm::min(a.minimum, b.minimum), glm::max(a.maximum, b.maximum)};
}

}  // namespace

scene::Bounds transformed(const scene::Bounds& box, const glm::mat4& matrix) {
    const glm::vec3 centre = 0.5F * (box.minimum + box.maximum);
    const glm::vec3 half = 0.5F * (box.maximum - box.minimum);
    const glm::vec3 new_centre = glm::vec3(matrix * glm::vec4(centre, 1.0F));
    glm::vec3 new_half(0.0F);
    for (int axis = 0; axis < 3; ++axis) new_half += glm::abs(glm::vec3(matrix[axis])) * half[axis];
    return {new_centre - new_half, new_centre + new_half};
}

std::optional<scene::Bounds> united(std::span<const scene::Bounds> boxes) {
    std::optional<scene::Bounds> all;
    for (const scene::Bounds& box : boxes) all = all ? merged(*all, box) : box;
    return all;
}

scene::Bounds posed_bounds(const scene::Bounds& box, std::span<const glm::mat4> joints) {
    if (joints.empty()) return box;
    scene::Bounds all = transformed(box, joints.front());
    for (const glm::mat4& joint : joints.subspan(1)) all = merged(all, transformed(box, joint));
    return all;
}

Frustum::Frustum(const glm::mat4& view_projection) {
    const glm::vec4 w = glm::row(view_projection, 3);
    for (int axis = 0; axis < 3; ++axis) {
        planes_[static_cast<std::size_t>(2 * axis)] = w + glm::row(view_projection, axis);
        planes_[static_cast<std::size_t>(2 * axis + 1)] = w - glm::row(view_projection, axis);
    }
}

bool Frustum::may_see(const scene::Bounds& box) const {
    const glm::vec3 centre = 0.5F * (box.minimum + box.maximum);
    const glm::vec3 half = 0.5F * (box.maximum - box.minimum);
    for (const glm::vec4& plane : planes_) {
        const float reach = glm::dot(glm::abs(glm::vec3(plane)), half);
        if (glm::dot(glm::vec3(plane), centre) + plane.w < -reach) return false;
    }
    return true;
}

namespace {

glm::mat4 matrix_of(ecs::World& world, ecs::Entity entity) {
    const scene::WorldMatrix* placed = world.find<scene::WorldMatrix>(entity);
    return placed ? placed->matrix : glm::mat4(1.0F);
}

glm::vec3 world_direction(ecs::World& world, ecs::Entity entity, const scene::DirectionalLight& light) {
    return glm::normalize(glm::mat3(matrix_of(world, entity)) * light.direction);
}

Light block_light(const scene::PunctualLight& light, const glm::mat4& matrix) {
    Light result = {};
    const float range2 = light.range_m * light.range_m;
    result.position = glm::vec4(glm::vec3(matrix[3]), range2 > 0.0F ? 1.0F / (range2 * range2) : 0.0F);
    result.strength.w = 0.25F * light.radius_m * light.radius_m;
    result.axis.w = 1.0F;
    if (!light.spot) return result;
    const float scale = 1.0F / std::max(1e-3F, std::cos(light.inner_cone) - std::cos(light.outer_cone));
    const glm::vec3 axis = glm::normalize(glm::mat3(matrix) * glm::vec3(0.0F, 0.0F, -1.0F));
    result.axis = glm::vec4(axis * scale, -std::cos(light.outer_cone) * scale);
    return result;
}

}  // namespace

SurfaceFeatures SceneLights::features() const {
    SurfaceFeatures features = 0;
    if (block.light_counts.x > 0.0F) features |= feature::kDirectionalLights;
    if (block.light_counts.x > 1.0F) features |= feature::kSeveralDirectionalLights;
    if (block.light_counts.y > block.light_counts.x) features |= feature::kPunctualLights;
    if (shadow_light) features |= feature::kShadows;
    return features;
}

SceneLights gather_lights(ecs::World& world, const glm::dmat3& rec709_to_working) {
    const glm::mat3 to_working(rec709_to_working);
    SceneLights result;
    std::vector<Light> lights;
    std::vector<glm::vec3>& strengths = result.strengths;
    world.view<scene::DirectionalLight>().each([&](ecs::Entity entity, const scene::DirectionalLight& light) {
        const glm::vec3 direction = world_direction(world, entity, light);
        lights.push_back({});
        lights.back().position = glm::vec4(direction, 0.0F);
        const float sine = std::sin(light.angular_radius);
        lights.back().strength.w = 0.25F * sine * sine;
        strengths.push_back(light.irradiance);
        if (!light.casts_shadow || result.shadow_light) return;
        result.shadow_light = direction;
        std::swap(lights.front(), lights.back());
        std::swap(strengths.front(), strengths.back());
    });
    const std::size_t directional = lights.size();
    world.view<scene::PunctualLight>().each([&](ecs::Entity entity, const scene::PunctualLight& light) {
        lights.push_back(block_light(light, matrix_of(world, entity)));
        strengths.push_back(light.intensity);
    });
    constexpr std::size_t kMaximum = ROWLAND_MAXIMUM_LIGHTS;
    const std::size_t kept = std::min(lights.size(), kMaximum);
    for (std::size_t i = 0; i < kept; ++i) {
        lights[i].strength = glm::vec4(to_working * strengths[i], lights[i].strength.w);
        result.block.lights[i] = lights[i];
    }
    strengths.resize(kept);
    result.dropped = static_cast<int>(lights.size() - kept);
    result.block.light_counts =
        glm::vec4(static_cast<float>(std::min(directional, kept)), static_cast<float>(kept), 0.0F, 0.0F);
    return result;
}

std::vector<DistantLight> distant_lights(ecs::World& world) {
    std::vector<DistantLight> lights;
    world.view<scene::DirectionalLight>().each([&](ecs::Entity entity, const scene::DirectionalLight& light) {
        lights.push_back({world_direction(world, entity, light), light.irradiance});
    });
    return lights;
}

namespace {

constexpr float kMarginTexels = 4.0F;  ///< empty at each edge: for filtering, SHADOW_LIFT and snapping to texels

/// `length` rounded up to a power of 2^¼.
float round_up(float length) {
    return std::exp2(std::ceil(4.0F * std::log2(length)) / 4.0F);
}

/// World to axes across the light (x, y) and toward it (z).
glm::mat3 light_axes(const glm::vec3& toward_light) {
    const glm::vec3 x = scene::any_perpendicular(toward_light);
    return glm::transpose(glm::mat3(x, glm::cross(toward_light, x), toward_light));
}

/// Intersection of both across the light, at the casters' depth; `seen` if it is empty.
scene::Bounds shadowed_region(const scene::Bounds& casters, const scene::Bounds& seen) {
    scene::Bounds region{glm::max(casters.minimum, seen.minimum), glm::min(casters.maximum, seen.maximum)};
    if (region.minimum.x > region.maximum.x || region.minimum.y > region.maximum.y) region = seen;
    region.minimum.z = casters.minimum.z;
    region.maximum.z = casters.maximum.z;
    return region;
}

}  // namespace

Sphere around_view(const scene::Camera& camera, float aspect, float far_distance) {
    const float far = round_up(std::clamp(far_distance, camera.near_plane * 1.01F, camera.far_plane));
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
    for (const scene::Bounds& caster : casters.subspan(1)) cast = merged(cast, transformed(caster, glm::mat4(axes)));
    const glm::vec3 centre = axes * seen.centre;
    const scene::Bounds region = shadowed_region(cast, {centre - seen.radius, centre + seen.radius});

    const auto texels = static_cast<float>(size);
    const glm::vec3 extent = region.maximum - region.minimum;
    const float side = round_up(std::max({extent.x, extent.y, 1e-4F}) * texels / (texels - 2.0F * kMarginTexels));
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

float penumbra_over_depth(const ShadowView& view, int size, float angular_radius) {
    const float depth_m = 2.0F / glm::length(glm::vec3(glm::row(view.world_to_clip, 2)));
    return std::tan(angular_radius) * depth_m / (view.texel_m * static_cast<float>(size));
}

}  // namespace rowland::render
