#pragma once

#include <memory>

#include "engine/gpu/buffer.h"
#include "engine/gpu/vertex_array.h"
#include "engine/scene/mesh.h"

namespace rowland::render {

/// A mesh on the GPU: position, normal and tangent interleaved at locations 0, 1 and 2.
class GpuMesh {
 public:
    explicit GpuMesh(const scene::Mesh& mesh);

    void draw() const { vertices_.draw_indexed(index_count_); }

 private:
    gpu::Buffer vertex_buffer_;
    gpu::Buffer index_buffer_;
    gpu::VertexArray vertices_;
    int index_count_ = 0;
};

/// Component: what an entity looks like. The CPU mesh stays for what is computed per vertex.
struct MeshInstance {
    std::shared_ptr<const scene::Mesh> mesh;
    std::shared_ptr<const GpuMesh> gpu;
};

MeshInstance make_mesh_instance(scene::Mesh mesh);

}  // namespace rowland::render
