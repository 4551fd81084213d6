#include "engine/render/gpu_mesh.h"

#include <span>
#include <vector>

namespace rowland::render {

namespace {

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec3 tangent;
};

std::vector<Vertex> interleave(const scene::Mesh& mesh) {
    std::vector<Vertex> vertices(mesh.positions.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        vertices[i] = {mesh.positions[i], mesh.normals[i], glm::vec3(mesh.tangents[i])};
    return vertices;
}

}  // namespace

GpuMesh::GpuMesh(const scene::Mesh& mesh)
    : vertex_buffer_(gpu::Buffer::of(std::span<const Vertex>(interleave(mesh)))),
      index_buffer_(gpu::Buffer::of(std::span<const std::uint32_t>(mesh.indices))),
      index_count_(static_cast<int>(mesh.indices.size())) {
    vertices_.attach(vertex_buffer_, sizeof(Vertex),
                     {{.location = 0, .components = 3, .offset = offsetof(Vertex, position)},
                      {.location = 1, .components = 3, .offset = offsetof(Vertex, normal)},
                      {.location = 2, .components = 3, .offset = offsetof(Vertex, tangent)}});
    vertices_.attach_indices(index_buffer_);
}

MeshInstance make_mesh_instance(scene::Mesh mesh) {
    auto shared = std::make_shared<const scene::Mesh>(std::move(mesh));
    auto uploaded = std::make_shared<const GpuMesh>(*shared);
    return {std::move(shared), std::move(uploaded)};
}

}  // namespace rowland::render
