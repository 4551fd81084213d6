#pragma once

#include "content/demo/play/play.h"
#include "engine/ecs/world.h"
#include "engine/render/scene_instance.h"

namespace rowland::demo {

/// An object of all the mesh entities below `node` as they stand now, which becomes its state of rest. No name, axis or
/// grip yet.
Body body_of(ecs::World& world, ecs::Entity node);

/// The nodes that a scene's extras make toys: `"grab": true`, and `"spin_axis": [x, y, z]`, about which one turns 20
/// degrees a second. Anything else under those keys is not for us.
std::vector<Body> bodies_of(ecs::World& world, const render::SceneInstance& instance);

/// Everything in the world that has a mesh and no skin, with the nearest body above it that may be grabbed.
void add_targets(ecs::World& world, Toys& toys);

}  // namespace rowland::demo
