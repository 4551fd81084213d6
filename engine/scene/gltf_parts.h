#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/gltf_document.h"
#include "engine/scene/gltf_json.h"
#include "engine/scene/gltf_source.h"
#include "engine/scene/memory_budget.h"

// The parts of a glTF file, each read in a source file of its own. All of them check what they read and throw Error
// (input) with the JSON pointer; what they ignore is added to the warnings.
namespace rowland::scene {

/// gltf_node.cpp: extras that take more characters as text are left out with a warning.
inline constexpr std::size_t kMostExtrasBytes = 65536;
std::vector<GltfNode> read_nodes(const GltfJson& json, std::size_t light_count);

/// gltf_texture.cpp: images and textures.
std::vector<GltfImage> read_images(const GltfJson& json);
std::vector<GltfTexture> read_textures(const GltfJson& json);
/// A material's texture under `key` of `owner`, with KHR_texture_transform. nullopt if it is missing, or, with a
/// warning, if it has no image that we read or uses a set of texture coordinates above the second.
std::optional<TextureUse> read_texture_use(const GltfJson& json, JsonReader& owner, const std::string& key,
                                           std::span<const GltfTexture> textures);

/// gltf_material.cpp
std::vector<MaterialDescription> read_materials(const GltfJson& json, std::span<const GltfTexture> textures);

/// gltf_light.cpp: KHR_lights_punctual.
inline constexpr const char* kLightExtension = "KHR_lights_punctual";
std::vector<GltfLight> read_lights(const GltfJson& json);

/// gltf_camera.cpp: nullopt for orthographic cameras, which are ignored with a warning.
std::vector<std::optional<ImportedCamera>> read_cameras(const GltfJson& json);

/// gltf_skin.cpp
std::vector<GltfSkin> read_skins(const GltfJson& json);
/// One skin with its joints as shown nodes: `shown` maps the document's nodes to the scene's. Throws also if a joint is
/// not shown, or if the inverse bind matrices are too few or not finite.
ImportedSkin import_skin(const GltfDocument& document, std::size_t skin,
                         std::span<const std::optional<std::size_t>> shown, MemoryBudget& budget);

/// gltf_animation.cpp: the animations that move shown nodes. Throws also if keys are not finite, not ascending or of
/// the wrong type or number.
std::vector<Animation> import_animations(const GltfJson& json, const GltfDocument& document,
                                         std::span<const std::optional<std::size_t>> shown, MemoryBudget& budget);

/// gltf_image.cpp: fills the images and textures of `scene`. Images that a texture names are decoded, each once; the
/// others, and textures without an image, get a white texel, so that indices are the file's and always valid.
/// `read_files`, if given, receives the files read.
void import_images(const GltfSource& source, const GltfDocument& document, MemoryBudget& budget,
                   std::vector<std::filesystem::path>* read_files, ImportedScene& scene);

}  // namespace rowland::scene
