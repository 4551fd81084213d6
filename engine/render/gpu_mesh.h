#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <memory>

#include "engine/gpu/buffer.h"
#include "engine/scene/mesh.h"

namespace rowland::render {

/// Where an instance of a mesh is drawn: attributes 8 to 14.
struct Placement {
    glm::mat4x3 object_to_world{1.0F};
    glm::mat3 normal_to_world{1.0F};  ///< inverse transpose
};

/// A mesh on the GPU: position, normal and tangent interleaved at locations 0, 1 and 2. Optional
/// attributes have separate buffers, so that programs which do not read them do not fetch them: first and second
/// texture coordinates at 3 and 4, colour at 5, joints and weights at 6 and 7.
class GpuMesh {
 public:
    explicit GpuMesh(const scene::Mesh& mesh);

    void draw() const { vertices_.draw_indexed(index_count_); }
    /// Draws it for so many Placements, which lie in the buffer from `offset` on, with a program that has INSTANCED.
    void draw_instances(const gpu::StreamBuffer& placements, std::size_t offset, int count) const;

    /// In the mesh's own space.
    const scene::Bounds& bounds() const { return bounds_; }
    bool has_colours() const { return colours_.size() > 0; }
    bool is_skinned() const { return joint_count_ > 0; }
    /// How many joints a skin must have for this mesh; 0 if it is not skinned.
    std::size_t joint_count() const { return joint_count_; }

 private:
    gpu::Buffer vertex_buffer_;
    gpu::Buffer index_buffer_;
    gpu::Buffer uvs_;
    gpu::Buffer uvs1_;
    gpu::Buffer colours_;
    gpu::Buffer joints_;
    gpu::Buffer weights_;
    gpu::VertexArray vertices_;
    int index_count_ = 0;
    std::size_t joint_count_ = 0;
    scene::Bounds bounds_;
};

/// Component: an entity's mesh. The CPU copy is for per-vertex computations.
struct MeshInstance {
    std::shared_ptr<const scene::Mesh> mesh;
    std::shared_ptr<const GpuMesh> gpu;
};

MeshInstance make_mesh_instance(scene::Mesh mesh);

}  // namespace rowland::render
