#pragma once

#include "content/demo/play/play.h"
#include "engine/ecs/world.h"
#include "engine/render/scene_instance.h"

namespace rowland::demo {

/// The body of all mesh entities below `node`. Their present pose becomes its rest pose. It has no name and no axis,
/// and cannot be grabbed yet.
Body body_of(ecs::World& world, ecs::Entity node);

/// The nodes that a scene's extras make toys: `"grab": true`, and `"spin_axis": [x, y, z]`, about which a node turns 20
/// degrees per second. Other values under those keys are ignored.
std::vector<Body> bodies_of(ecs::World& world, const render::SceneInstance& instance);

/// Adds everything in the world with a mesh and no skin, each with the nearest body above it that may be grabbed.
void add_targets(ecs::World& world, Toys& toys);

}  // namespace rowland::demo
