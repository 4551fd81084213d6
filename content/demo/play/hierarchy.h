#pragma once

#include <glm/mat4x4.hpp>
#include <string>

#include "engine/ecs/world.h"

namespace rowland::demo {

/// Null (never alive) at the top of the hierarchy.
ecs::Entity parent_of(ecs::World& world, ecs::Entity entity);

/// Object to world, from the present transforms: needs no update_world_matrices().
glm::mat4 object_to_world(ecs::World& world, ecs::Entity entity);

/// The name of an object: that of the nearest node at or above it that has one; else "grating".
std::string name_of_object(ecs::World& world, ecs::Entity entity);

}  // namespace rowland::demo
