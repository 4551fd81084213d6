#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/scene/gltf_document.h"

namespace rowland::scene {

/// Parses JSON that has passed check_gltf_json. Buffers are left empty. What is ignored is added to `warnings`. Throws
/// Error (input).
GltfDocument parse_gltf(const nlohmann::json& checked, const std::string& file, std::vector<std::string>& warnings);

/// The bytes of a base64 data URI of any media type; empty if it is not one.
std::vector<std::byte> decode_data_uri(const std::string& uri);

}  // namespace rowland::scene
