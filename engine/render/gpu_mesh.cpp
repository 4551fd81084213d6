#include "engine/render/gpu_mesh.h"

#include <algorithm>
#include <span>
#include <vector>

namespace rowland::render {

namespace {

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec4 tangent;
};

std::vector<Vertex> interleave(const scene::Mesh& mesh) {
    std::vector<Vertex> vertices(mesh.positions.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        vertices[i] = {mesh.positions[i], mesh.normals[i], mesh.tangents[i]};
    return vertices;
}

/// Joints of weight 0, whose indices may be out of range, are replaced by the heaviest.
std::vector<glm::u16vec4> joints_in_use(const scene::Mesh& mesh) {
    std::vector<glm::u16vec4> joints = mesh.joints;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const glm::vec4& weights = mesh.weights[i];
        int heaviest = 0;
        for (int k = 1; k < 4; ++k)
            if (weights[k] > weights[heaviest]) heaviest = k;
        for (int k = 0; k < 4; ++k)
            if (weights[k] == 0.0F) joints[i][k] = joints[i][heaviest];
    }
    return joints;
}

std::size_t count(const std::vector<glm::u16vec4>& joints) {
    std::size_t most = 0;
    for (const glm::u16vec4& four : joints)
        for (int k = 0; k < 4; ++k) most = std::max(most, std::size_t{four[k]} + 1);
    return most;
}

/// Uploads an attribute that the mesh may lack.
template <typename T>
gpu::Buffer attach_if_present(gpu::VertexArray& vertices, const std::vector<T>& values, unsigned location,
                              gpu::VertexNumber number = gpu::VertexNumber::Float) {
    if (values.empty()) return {};
    gpu::Buffer buffer = gpu::Buffer::of(std::span<const T>(values));
    vertices.attach(buffer, sizeof(T), {{.location = location, .components = T::length(), .number = number}});
    return buffer;
}

}  // namespace

GpuMesh::GpuMesh(const scene::Mesh& mesh)
    : vertex_buffer_(gpu::Buffer::of(std::span<const Vertex>(interleave(mesh)))),
      index_buffer_(gpu::Buffer::of(std::span<const std::uint32_t>(mesh.indices))),
      index_count_(static_cast<int>(mesh.indices.size())),
      bounds_(scene::bounds(mesh)) {
    vertices_.attach(vertex_buffer_, sizeof(Vertex),
                     {{.location = 0, .components = 3, .offset = offsetof(Vertex, position)},
                      {.location = 1, .components = 3, .offset = offsetof(Vertex, normal)},
                      {.location = 2, .components = 4, .offset = offsetof(Vertex, tangent)}});
    uvs_ = attach_if_present(vertices_, mesh.uvs, 3);
    uvs1_ = attach_if_present(vertices_, mesh.uvs1, 4);
    colours_ = attach_if_present(vertices_, mesh.colours, 5);
    const std::vector<glm::u16vec4> joints = joints_in_use(mesh);
    joint_count_ = count(joints);
    joints_ = attach_if_present(vertices_, joints, 6, gpu::VertexNumber::UInt16);
    weights_ = attach_if_present(vertices_, mesh.weights, 7);
    vertices_.attach_indices(index_buffer_);
    static_assert(sizeof(Placement) == 7 * sizeof(glm::vec3));
    vertices_.attach_instances(8, 7);
}

void GpuMesh::draw_instances(const gpu::StreamBuffer& placements, std::size_t offset, int count) const {
    vertices_.draw_instances(index_count_, placements, offset, count);
}

MeshInstance make_mesh_instance(scene::Mesh mesh) {
    auto shared = std::make_shared<const scene::Mesh>(std::move(mesh));
    auto uploaded = std::make_shared<const GpuMesh>(*shared);
    return {std::move(shared), std::move(uploaded)};
}

}  // namespace rowland::render
