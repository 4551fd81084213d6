#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/gltf_document.h"

namespace rowland::scene {

/// The lights of a glTF's JSON (KHR_lights_punctual), checked as they are read. Throws Error (input).
std::vector<GltfLight> read_lights(const nlohmann::json& json, const std::string& file);

/// Sets the light of each node that has one, below `light_count`. Throws Error (input).
void read_node_lights(const nlohmann::json& json, const std::string& file, std::span<GltfNode> nodes,
                      std::size_t light_count);

}  // namespace rowland::scene
