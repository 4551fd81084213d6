#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/json_reader.h"
#include "engine/scene/gltf_document.h"

namespace rowland::scene {

/// The images and textures of a glTF's JSON, checked as they are read. Throws Error (input).
std::vector<GltfImage> read_images(const nlohmann::json& json, const std::string& file);
std::vector<GltfTexture> read_textures(const nlohmann::json& json, const std::string& file,
                                       std::vector<std::string>& warnings);

/// A material's texture under `key` of `owner`, with KHR_texture_transform. None if it is not there, or, with a
/// warning, if it has no image that we read or uses a set of texture coordinates above the second. Throws Error
/// (input).
std::optional<TextureUse> read_texture_use(const nlohmann::json& json, JsonReader& owner, const std::string& key,
                                           std::span<const GltfTexture> textures, std::vector<std::string>& warnings);

}  // namespace rowland::scene
