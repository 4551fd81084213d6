#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/cook/registry.h"
#include "engine/scene/imported_scene.h"

namespace rowland::scene {

inline constexpr const char* kSceneAssetType = "scene";

/// Adds the asset type "scene": a .gltf or .glb is cooked to one GLB that names no other file, and to the tables of the
/// material extensions that are registered by now.
void register_scene_type(cook::Registry& registry);
/// Adds this type and the type "mesh": a recipe, which is a .json file with the key "mesh", is cooked to a .glb.
void register_cook_types(cook::Registry& registry);

/// A cooked scene from its payload, which may be hostile. Throws Error (input).
ImportedScene read_cooked_scene(std::span<const std::byte> payload, const std::string& file,
                                std::span<const std::string> handled_extensions);

}  // namespace rowland::scene
