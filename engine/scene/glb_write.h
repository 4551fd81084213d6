#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/scene/mesh.h"

namespace rowland::scene {

/// Quantisation of a written mesh, bits per component. Draco stores a component as one of 2^bits steps over the
/// attribute's largest extent, so its error is half of extent / (2^bits − 1): 0.9 µm on a 12 cm disc, and 1.5e-5 per
/// component for tangents, which rotates a tangent by at most 2.7e-5 rad. Normals are stored octahedrally, with an
/// error of at most √18 / (2^bits − 2), 6.5e-5.
inline constexpr int kDracoBits = 16;

/// Ids of the attributes in the stream.
struct DracoIds {
    static constexpr int kPosition = 0;
    static constexpr int kNormal = 1;
    static constexpr int kTangent = 2;
    static constexpr int kUv = 3;
};

struct DracoStream {
    std::vector<char> bytes;
    Bounds bounds;  ///< of the positions as readers will decode them
};

/// Encodes positions, normals, tangents and uvs sequentially: every vertex and triangle keeps its index. Deterministic.
/// The mesh must have triangles and no more vertices than indices. Throws Error (system) if Draco fails.
DracoStream encode_draco(const Mesh& mesh);

/// A binary glTF 2.0 file of one mesh at one node, both called `name`: positions, normals, tangents and uvs,
/// Draco-compressed (KHR_draco_mesh_compression is required to read it). The same mesh gives the same bytes. Throws
/// Error (system) if Draco fails.
std::vector<std::byte> write_glb(const Mesh& mesh, const std::string& name = "mesh");

}  // namespace rowland::scene
