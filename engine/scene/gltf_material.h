#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/gltf_document.h"

namespace rowland::scene {

/// The materials of a glTF's JSON, checked as they are read. Throws Error (input).
std::vector<MaterialDescription> read_materials(const nlohmann::json& json, const std::string& file,
                                                std::span<const GltfTexture> textures,
                                                std::vector<std::string>& warnings);

}  // namespace rowland::scene
