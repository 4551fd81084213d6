#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/scene/punctual_light.h"

namespace rowland::demo {

/// The most lights in a world: as many as the renderer draws.
inline constexpr std::size_t kMostLights = 64;

/// All lights of the world, not only the player's.
std::size_t light_count(ecs::World& world);

/// Lights that the player adds, each in the next of a few colours.
class PlayerLights {
 public:
    /// A light at `position`, relative to `parent`, that lights what is `reach` metres away about as a room does. Adds
    /// nothing and returns false if the world has kMostLights.
    bool add(ecs::World& world, ecs::Entity parent, const glm::vec3& position, float reach);
    /// Removes the last one; false if there is none.
    bool remove(ecs::World& world);

    const std::vector<ecs::Entity>& entities() const { return lights_; }

 private:
    std::vector<ecs::Entity> lights_;
};

}  // namespace rowland::demo
