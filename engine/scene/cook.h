#pragma once

#include "engine/cook/registry.h"

namespace rowland::scene {

/// Adds the asset types "mesh" (a recipe, a .json with that key, which becomes a .glb) and "scene"
/// (register_scene_type()).
void register_cook_types(cook::Registry& registry);

}  // namespace rowland::scene
