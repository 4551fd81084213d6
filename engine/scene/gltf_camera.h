#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/gltf_document.h"

namespace rowland::scene {

/// The cameras of a glTF's JSON, checked as they are read; none where one is orthographic, which is ignored with a
/// warning. Throws Error (input).
std::vector<std::optional<GltfCamera>> read_cameras(const nlohmann::json& json, const std::string& file,
                                                    std::vector<std::string>& warnings);

/// Sets the camera of each node that has one. Throws Error (input) if it names none of the file's.
void read_node_cameras(const nlohmann::json& json, const std::string& file, std::span<GltfNode> nodes);

}  // namespace rowland::scene
