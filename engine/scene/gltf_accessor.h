#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/gltf_document.h"
#include "engine/scene/memory_budget.h"

namespace rowland::scene {

/// Checks without overflow that every buffer view lies in its buffer and every accessor, with its sparse parts, in its
/// views. Throws Error (input).
void check_ranges(const GltfDocument& document);

std::span<const std::byte> view_bytes(const GltfDocument& document, std::size_t view);

/// The elements of an accessor as vectors of floats (glm::vec2, vec3 or vec4): zeros without a buffer view, with sparse
/// elements replaced, normalised integers mapped to [0, 1] or [−1, 1]. Values may be infinite or NaN if the file says
/// so. Throws Error (input) if the accessor's type does not fit.
template <typename Vector>
std::vector<Vector> read_vectors(const GltfDocument& document, std::size_t accessor, MemoryBudget& budget);

/// The same for scalars, and for 4 × 4 matrices of floats.
std::vector<float> read_floats(const GltfDocument& document, std::size_t accessor, MemoryBudget& budget);
std::vector<glm::mat4> read_matrices(const GltfDocument& document, std::size_t accessor, MemoryBudget& budget);

/// The elements of an accessor of unsigned integers. Throws Error (input) if it is not one.
std::vector<std::uint32_t> read_indices(const GltfDocument& document, std::size_t accessor, MemoryBudget& budget);

}  // namespace rowland::scene
