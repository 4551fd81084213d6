#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/core/json_reader.h"
#include "engine/scene/gltf_source.h"

namespace rowland::scene {

inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";
inline constexpr const char* kLightExtension = "KHR_lights_punctual";
inline constexpr const char* kTextureTransformExtension = "KHR_texture_transform";
inline constexpr const char* kWearExtension = "ROWLAND_materials_wear";
inline constexpr const char* kProbeExtension = "ROWLAND_light_probe";
/// Of its boxes, in metres.
inline constexpr NumberRange kProbeBoxSide{.minimum = 1e-3, .maximum = 1e6};
inline constexpr NumberRange kProbeFade{.minimum = 0.0, .maximum = 1e6};

/// The JSON Schemas of the engine's own extensions, by name.
std::map<std::string, std::function<nlohmann::ordered_json()>> own_extension_schemas();

/// Adds `text` unless it is already there.
void warn_once(std::vector<std::string>& warnings, std::string text);

/// Verifies a glTF's JSON: every member that we read has the right type and range, every index refers to an existing
/// element, required extensions are supported or among `handled_extensions`. Call it before tinygltf, which silently
/// drops elements with members of a wrong type and truncates large integers. Returns the members that we read and no
/// others, and charges the memory of tinygltf's structures for them to `budget`. Ignored extensions are added to the
/// warnings. Throws Error (input) with the JSON pointer.
nlohmann::json check_gltf(const nlohmann::json& root, const std::string& file,
                          std::span<const std::string> handled_extensions, MemoryBudget& budget,
                          std::vector<std::string>& warnings);

}  // namespace rowland::scene
