#include "content/demo/play/player_lights.h"

#include <array>

#include "engine/scene/directional_light.h"
#include "engine/scene/transform.h"

namespace rowland::demo {

namespace {

// Linear Rec.709, each of luminance 1.
constexpr std::array<glm::vec3, 8> kColours = {{{1.38F, 0.92F, 0.52F},   // candle
                                                {0.86F, 1.01F, 1.31F},   // overcast sky
                                                {2.05F, 0.66F, 1.28F},   // rose
                                                {0.35F, 1.21F, 0.87F},   // sea
                                                {1.75F, 0.88F, 0.12F},   // amber
                                                {0.77F, 0.88F, 2.87F},   // violet
                                                {1.0F, 1.0F, 1.0F},      // white
                                                {0.95F, 1.1F, 0.22F}}};  // lime
constexpr float kIrradiance = 1.5F;                                      ///< at the reach

}  // namespace

std::size_t light_count(ecs::World& world) {
    return world.view<scene::DirectionalLight>().count() + world.view<scene::PunctualLight>().count();
}

bool PlayerLights::add(ecs::World& world, ecs::Entity parent, const glm::vec3& position, float reach) {
    if (light_count(world) >= kMostLights) return false;
    const ecs::Entity entity = world.create();
    world.add(entity, scene::Transform{.translation = position});
    world.add(entity, scene::Parent{parent});
    constexpr float kRangeInReaches = 8.0F;
    world.add(entity, scene::PunctualLight{
                          .intensity = kColours[lights_.size() % kColours.size()] * kIrradiance * reach * reach,
                          .range_m = kRangeInReaches * reach});
    lights_.push_back(entity);
    return true;
}

bool PlayerLights::remove(ecs::World& world) {
    if (lights_.empty()) return false;
    world.destroy(lights_.back());
    lights_.pop_back();
    return true;
}

}  // namespace rowland::demo
