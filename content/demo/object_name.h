#pragma once

#include <string>

#include "engine/ecs/world.h"

namespace rowland::demo {

/// The name of an object: that of the nearest node at or above it that has one; else "grating".
std::string name_of_object(ecs::World& world, ecs::Entity entity);

}  // namespace rowland::demo
