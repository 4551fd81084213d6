#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "engine/ecs/world.h"

namespace rowland::scene {

/// Component: placement relative to the parent, or to the world if there is none. Metres.
struct Transform {
    glm::vec3 translation{0.0F};
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec3 scale{1.0F};

    glm::mat4 matrix() const;
};

/// Component: the entity whose Transform ours is relative to.
struct Parent {
    ecs::Entity entity;
};

/// Component, written by update_world_matrices: object to world.
struct WorldMatrix {
    glm::mat4 matrix{1.0F};
};

/// System: gives every entity with a Transform its WorldMatrix. A dead parent counts as none; a cycle of parents is a
/// contract violation.
void update_world_matrices(ecs::World& world);

}  // namespace rowland::scene
