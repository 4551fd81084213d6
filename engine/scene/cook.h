#pragma once

#include "engine/cook/registry.h"

namespace rowland::scene {

/// Adds the asset types "mesh" and "scene" (recipes, a .json with that key; each becomes a .glb) and "gltf" (.gltf and
/// .glb files, only checked, with the material extensions that are registered by now).
void register_cook_types(cook::Registry& registry);

}  // namespace rowland::scene
