#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/gltf_check.h"
#include "engine/scene/gltf_source.h"
#include "engine/scene/tinygltf.h"

namespace rowland::scene {

/// A glTF file, checked and parsed: all indices are in range, all buffer views lie in their buffers and all accessors
/// in their views. −1 stands for no index, as tinygltf has it.
struct GltfDocument {
    std::string file;            ///< for messages
    const nlohmann::json& json;  ///< the source's, with extras and all extensions
    gltf::Model model;           ///< without the buffers, and with the members that we read only
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

/// The same for scalars, and for 4 × 4 matrices of floats.
std::vector<float> read_floats(const GltfDocument& document, int accessor, MemoryBudget& budget);
std::vector<glm::mat4> read_matrices(const GltfDocument& document, int accessor, MemoryBudget& budget);

/// The elements of an accessor of unsigned integers. Throws Error (input) if it is not one.
std::vector<std::uint32_t> read_indices(const GltfDocument& document, int accessor, MemoryBudget& budget);

}  // namespace rowland::scene
