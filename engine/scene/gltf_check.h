#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace rowland::scene {

/// Adds `text` unless it is there already.
void warn_once(std::vector<std::string>& warnings, std::string text);

/// Checks the JSON of a glTF file before any other code sees it: version, required extensions and, of geometry and
/// nodes, the type and range of every property we read and that every index names something. (Materials, textures,
/// skins, animations, lights and cameras are checked where they are read: gltf_material.h and its like.) What we do not
/// read is only looked at where the parser would stumble. Ignored extensions and features are added to `warnings`.
/// Throws Error (input) with the JSON pointer.
void check_gltf_json(const nlohmann::json& json, const std::string& file,
                     std::span<const std::string> handled_extensions, std::vector<std::string>& warnings);

}  // namespace rowland::scene
