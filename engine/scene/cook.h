#pragma once

#include "engine/cook/registry.h"

namespace rowland::scene {

/// Adds the asset types "mesh" and "scene" (recipes, a .json with that key; each becomes a .glb) and "gltf" (.gltf and
/// .glb files, only checked). `handled_extensions` are the material extensions with a registered handler.
void register_cook_types(cook::Registry& registry, std::vector<std::string> handled_extensions = {});

}  // namespace rowland::scene
