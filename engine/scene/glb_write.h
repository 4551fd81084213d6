#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/scene/mesh.h"

namespace rowland::scene {

/// Quantisation of a written mesh, in bits a component. Draco stores a component as one of 2^bits steps over the
/// attribute's largest extent, so its error is half of extent / (2^bits − 1). At 16 bits that is 0.9 µm on a 12 cm disc
/// and 1.5e-5 a component for tangents, which turns a tangent by at most 2.7e-5 rad. Normals are stored
/// octahedrally, with an error of at most √18 / (2^bits − 2), 6.5e-5.
struct GlbWriteSettings {
    int position_bits = 16;  ///< 2 … 30, like the others
    int normal_bits = 16;
    int tangent_bits = 16;
    int uv_bits = 16;
    std::string name = "mesh";  ///< of the node and the mesh
};

/// A binary glTF 2.0 file with one Draco-compressed mesh (KHR_draco_mesh_compression is required to read it):
/// positions, normals, tangents and uvs. Encoded sequentially: every vertex and triangle survives, in order. The same
/// mesh gives the same bytes. Throws Error (system) if Draco fails.
std::vector<std::byte> write_glb(const Mesh& mesh, const GlbWriteSettings& settings = {});

}  // namespace rowland::scene
