#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/draco_decode.h"
#include "engine/scene/gltf_check.h"
#include "engine/scene/gltf_source.h"
#include "engine/scene/imported_scene.h"
#include "engine/scene/tinygltf.h"

// Functions that make the parts of an ImportedScene from those of a checked glTF file. All throw Error (input) with the
// JSON pointer; the scene's warnings say what they ignored or repaired.
namespace rowland::scene {

// gltf_model.cpp: the file and its accessors.

/// A glTF file, checked and parsed: all indices are in range, all buffer views lie in their buffers and all accessors
/// in their views. −1 stands for no index, as tinygltf has it.
struct GltfDocument {
    std::string file;            ///< for messages
    const nlohmann::json& json;  ///< the source's, with extras and all extensions
    gltf::Model model;           ///< without the buffers, and only with the members that we read
    std::vector<GltfBuffer> buffers;

    std::span<const std::byte> view_bytes(int view) const;
    /// The "extras" of an element of an array of the root; null: none.
    const nlohmann::json& extras(const char* array, std::size_t index) const;
};

/// Checks and parses a file and loads its buffers. Ignored extensions are added to the warnings. `read_files`, if
/// given, receives the files read. `source` must outlive the document. Throws Error (input).
GltfDocument parse_gltf(const GltfSource& source, std::span<const std::string> handled_extensions, MemoryBudget& budget,
                        std::vector<std::filesystem::path>* read_files, std::vector<std::string>& warnings);

/// The elements of an accessor as vectors of floats (glm::vec2, vec3 or vec4): zeros without a buffer view, with sparse
/// elements replaced, normalised integers mapped to [0, 1] or [−1, 1]. Values may be infinite or NaN if the file says
/// so. Throws Error (input) if the accessor's type does not fit.
template <typename Vector>
std::vector<Vector> read_vectors(const GltfDocument& document, int accessor, MemoryBudget& budget);

/// The same for scalar floats, and for 4 × 4 matrices of floats.
std::vector<float> read_floats(const GltfDocument& document, int accessor, MemoryBudget& budget);
std::vector<glm::mat4> read_matrices(const GltfDocument& document, int accessor, MemoryBudget& budget);

/// The elements of an accessor of unsigned integers. Throws Error (input) if it is not one.
std::vector<std::uint32_t> read_indices(const GltfDocument& document, int accessor, MemoryBudget& budget);

/// gltf_material.cpp: a member of an extension's object as a number; `fallback` if it is missing.
double number_or(const gltf::Value& object, const std::string& key, double fallback);
/// The materials.
std::vector<MaterialDescription> import_materials(const GltfDocument& document, std::vector<std::string>& warnings);
/// Fills the images and textures of `scene`. Images that a texture names are decoded, each once; the others, and
/// textures without an image, get a white texel, so that indices are the file's and always valid. `read_files`, if
/// given, receives the files read.
void import_images(const GltfSource& source, const GltfDocument& document, MemoryBudget& budget,
                   std::vector<std::filesystem::path>* read_files, ImportedScene& scene);

/// gltf_node.cpp: extras whose JSON text is longer are left out with a warning.
inline constexpr std::size_t kMostExtrasBytes = 65536;
/// For each node of the document, its index in the scene; nullopt: it is not shown.
using ShownNodes = std::vector<std::optional<std::size_t>>;
/// Adds the nodes of the scene to show, parents before their children, with their lights and cameras. Throws also if a
/// node is reached twice (a cycle, or two parents) or if a transform overflows.
ShownNodes import_nodes(const GltfDocument& document, MemoryBudget& budget, ImportedScene& scene);
/// One skin. Throws also if a joint is not shown, or if the inverse bind matrices are too few or not finite.
ImportedSkin import_skin(const GltfDocument& document, std::size_t skin, const ShownNodes& shown, MemoryBudget& budget);
/// The animations that move shown nodes. Throws also if keys are not finite, not ascending or of the wrong type or
/// number.
std::vector<Animation> import_animations(const GltfDocument& document, const ShownNodes& shown, MemoryBudget& budget);

/// gltf_primitive.cpp: whether a primitive has an attribute, in an accessor or in its Draco stream.
bool has_attribute(const gltf::Primitive& primitive, const std::string& name);
/// The mesh of one triangle primitive with positions: strips and fans become lists, indices and positions are checked,
/// missing or unusable normals and tangents generated. `normal_map_uvs`: which set of UVs the normal map uses, 0 or 1.
/// `pointer` is the primitive's JSON pointer.
Mesh import_primitive(const GltfDocument& document, const gltf::Primitive& primitive, int normal_map_uvs,
                      const std::string& pointer, DracoProcess& decoder, MemoryBudget& budget,
                      std::vector<std::string>& warnings);

}  // namespace rowland::scene
