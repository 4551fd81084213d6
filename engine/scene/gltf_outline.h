#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/scene/imported_scene.h"

namespace rowland::scene {

struct GltfMeshOutline {
    std::string name;
    std::vector<std::optional<std::size_t>> materials;  ///< of each primitive
};

/// What a glTF's materials are called and who uses them. Names may be empty and may repeat.
struct GltfOutline {
    std::vector<std::string> materials;
    std::vector<GltfMeshOutline> meshes;

    /// How many primitives use a material.
    std::size_t uses(std::size_t material) const;
};

/// Reads the outline, and checks the types of all that EditableGltf edits. Throws Error (input).
GltfOutline read_outline(const nlohmann::json& gltf, const std::string& file);

/// The names of the extensions in a JSON value: the keys of all "extensions" below it, but for those in "extras".
std::set<std::string> extensions_in(const nlohmann::ordered_json& value);

/// What a glTF's buffers and images name besides data URIs.
std::vector<std::string> named_files(const nlohmann::ordered_json& gltf);

}  // namespace rowland::scene
