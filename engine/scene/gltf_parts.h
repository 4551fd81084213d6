#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/draco_decode.h"
#include "engine/scene/gltf_model.h"
#include "engine/scene/imported_scene.h"

// The parts of a checked glTF file as the parts of an ImportedScene. All throw Error (input) with the JSON pointer;
// what they ignore or repair is added to the scene's warnings.
namespace rowland::scene {

/// gltf_material.cpp: the materials.
std::vector<MaterialDescription> import_materials(const GltfDocument& document, std::vector<std::string>& warnings);
/// Fills the images and textures of `scene`. Images that a texture names are decoded, each once; the others, and
/// textures without an image, get a white texel, so that indices are the file's and always valid. `read_files`, if
/// given, receives the files read.
void import_images(const GltfSource& source, const GltfDocument& document, MemoryBudget& budget,
                   std::vector<std::filesystem::path>* read_files, ImportedScene& scene);

/// gltf_node.cpp: extras that take more characters as text are left out with a warning.
inline constexpr std::size_t kMostExtrasBytes = 65536;
/// The scene's node of each of the document's nodes; nullopt: it is not shown.
using ShownNodes = std::vector<std::optional<std::size_t>>;
/// Adds the nodes of the scene to show, parents before their children, with their lights and cameras. Throws also if a
/// node is reached twice (a cycle, or two parents) or if a transform overflows.
ShownNodes import_nodes(const GltfDocument& document, MemoryBudget& budget, ImportedScene& scene);
/// One skin. Throws also if a joint is not shown, or if the inverse bind matrices are too few or not finite.
ImportedSkin import_skin(const GltfDocument& document, std::size_t skin, const ShownNodes& shown, MemoryBudget& budget);
/// The animations that move shown nodes. Throws also if keys are not finite, not ascending or of the wrong type or
/// number.
std::vector<Animation> import_animations(const GltfDocument& document, const ShownNodes& shown, MemoryBudget& budget);

/// gltf_primitive.cpp: whether an accessor or a Draco stream has an attribute.
bool has_attribute(const gltf::Primitive& primitive, const std::string& name);
/// The mesh of one triangle primitive with positions: strips and fans become lists, indices and positions are checked,
/// missing or unusable normals and tangents generated. `normal_map_uvs`: which set of UVs the normal map uses, 0 or 1.
/// `pointer` is the primitive's JSON pointer.
Mesh import_primitive(const GltfDocument& document, const gltf::Primitive& primitive, int normal_map_uvs,
                      const std::string& pointer, DracoProcess& decoder, MemoryBudget& budget,
                      std::vector<std::string>& warnings);

}  // namespace rowland::scene
