#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/scene/punctual_light.h"

namespace rowland::demo {

/// A world has at most so many lights, as the renderer draws.
inline constexpr std::size_t kMostLights = 64;

/// How many lights the world has, whoever put them there.
std::size_t light_count(ecs::World& world);

/// Lights that the player puts into the world, each in the next of a few colours.
class PlayerLights {
 public:
    /// A light at `place` that lights what is `reach` metres away about as a room does. Its place is relative to
    /// `parent`. False, and nothing is added, if the world has kMostLights.
    bool add(ecs::World& world, ecs::Entity parent, const glm::vec3& place, float reach);
    /// Takes the last one away; false if there is none.
    bool remove(ecs::World& world);

    const std::vector<ecs::Entity>& entities() const { return lights_; }

 private:
    std::vector<ecs::Entity> lights_;
};

}  // namespace rowland::demo
