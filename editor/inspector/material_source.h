#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "editor/inspector/new_textures.h"
#include "editor/inspector/ordered_json.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material.h"

namespace rowland::inspector {

/// A material that the module's parser accepted, with its source. Never changes, so the pointer to it is its identity.
struct MaterialSource {
    Json json;
    diffraction::Material material;
    std::string name;                                       ///< of the file, for messages
    diffraction::GltfGrating gltf = {};                     ///< `material` and, of a scene's, its grooves on the mesh
    std::shared_ptr<const NewTexture> groove_picture = {};  ///< null: the file's texture, or none
};

/// Parses a material file's object, or a scene material's extension, whose texture may be one of `textures`. Named
/// files are relative to `folder`. Throws Error (input) naming `file` and a location below `pointer`.
std::shared_ptr<const MaterialSource> accept_material(const Json& material, const std::string& file,
                                                      const std::filesystem::path& folder);
std::shared_ptr<const MaterialSource> accept_extension(const Json& extension, const std::string& file,
                                                       const std::filesystem::path& folder,
                                                       const std::string& pointer = "",
                                                       const NewTextures* textures = nullptr);

/// The material with its file names, which are relative to `from`, relative to `to`.
Json moved(Json material, const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace rowland::inspector
