#include "engine/render/scene_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "engine/scene/directional_light.h"
#include "engine/scene/punctual_light.h"
#include "engine/scene/transform.h"

namespace rowland::render {

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
        lights[i].strength = glm::vec4(to_working * strengths[i], 0.0F);
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

}  // namespace rowland::render
