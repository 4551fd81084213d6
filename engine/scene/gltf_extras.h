#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/gltf_document.h"

namespace rowland::scene {

/// A node's extras may take so many characters as text; an application's whole state is not for us.
inline constexpr std::size_t kMostExtrasBytes = 65536;

/// Sets the extras of each node that has some. Larger ones than kMostExtrasBytes are left out with a warning.
void read_node_extras(const nlohmann::json& json, const std::string& file, std::span<GltfNode> nodes,
                      std::vector<std::string>& warnings);

/// Whether extras say `"key": true`. What else others may mean by that key is no error.
bool says_true(const nlohmann::json& extras, const std::string& key);

}  // namespace rowland::scene
