#pragma once

#include <string>

#include "engine/ecs/world.h"

namespace rowland::demo {

/// How an object is called: the name of the nearest node above it that has one.
std::string name_of_object(ecs::World& world, ecs::Entity entity);

}  // namespace rowland::demo
