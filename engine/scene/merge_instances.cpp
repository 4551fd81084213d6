#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/memory_budget.h"
#include "engine/scene/skin.h"
#include "engine/scene/tangents.h"

namespace rowland::scene {

namespace {

/// det(m) times the inverse transpose; unlike that it exists for every matrix.
glm::dmat3 cofactors(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

/// `x` made unit, or `fallback` if it has no direction.
glm::vec3 unit_or(const glm::dvec3& x, const glm::vec3& fallback) {
    const double length = glm::length(x);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(x / length) : fallback;
}

void append(const Mesh& mesh, const glm::mat4& transform, const std::string& name, Mesh& merged) {
    const glm::dmat4 world(transform);
    const glm::dmat3 linear(world);
    const bool mirrored = glm::dot(glm::cross(linear[0], linear[1]), linear[2]) < 0.0;
    // Cofactors carry the determinant's sign; normals must not.
    const glm::dmat3 normal_matrix = (mirrored ? -1.0 : 1.0) * cofactors(linear);
    const auto first = static_cast<std::uint32_t>(merged.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 position(world * glm::dvec4(glm::dvec3(mesh.positions[i]), 1.0));
        if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z))
            throw Error({.file = {},
                         .place = fmt::format("instance \"{:.60}\"", name),
                         .found = "a vertex that its transform moves beyond the range of floats",
                         .expected = "finite positions",
                         .remedy = {}});
        merged.positions.push_back(position);
        const glm::vec3 normal = unit_or(normal_matrix * glm::dvec3(mesh.normals[i]), mesh.normals[i]);
        merged.normals.push_back(normal);
        const glm::dvec3 tangent = linear * glm::dvec3(glm::vec3(mesh.tangents[i]));
        const float w = mirrored ? -mesh.tangents[i].w : mesh.tangents[i].w;
        glm::vec4& added = merged.tangents.emplace_back(unit_or(tangent, glm::vec3(0.0F)), w);
        orthonormalise_tangent(added, normal);
    }
    merged.uvs.insert(merged.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        merged.indices.insert(merged.indices.end(),
                              {first + mesh.indices[i], first + mesh.indices[i + (mirrored ? 2 : 1)],
                               first + mesh.indices[i + (mirrored ? 1 : 2)]});
}

/// The joint matrices of a skin at rest.
std::vector<glm::mat4> rest_joints(const ImportedScene& scene, const ImportedSkin& skin) {
    std::vector<glm::mat4> joints;
    joints.reserve(skin.joints.size());
    for (std::size_t i = 0; i < skin.joints.size(); ++i)
        joints.push_back(scene.nodes.at(skin.joints[i]).world * skin.inverse_bind.at(i));
    return joints;
}

}  // namespace

Mesh merge_instances(const ImportedScene& scene) {
    MemoryBudget budget("");
    std::size_t vertex_count = 0;
    std::size_t index_count = 0;
    for (const ImportedInstance& instance : scene.instances) {
        ROWLAND_CHECK_OP(instance.mesh, <, scene.meshes.size());
        const Mesh& mesh = scene.meshes[instance.mesh];
        const std::string place = fmt::format("instance \"{:.60}\"", instance.name);
        budget.spend(mesh.positions.size(), 2 * sizeof(glm::vec3) + sizeof(glm::vec4) + sizeof(glm::vec2), place);
        budget.spend(mesh.indices.size(), sizeof(std::uint32_t), place);
        vertex_count += mesh.positions.size();
        index_count += mesh.indices.size();
    }
    Mesh merged;
    merged.positions.reserve(vertex_count);
    merged.normals.reserve(vertex_count);
    merged.tangents.reserve(vertex_count);
    merged.uvs.reserve(vertex_count);
    merged.indices.reserve(index_count);
    std::vector<std::vector<glm::mat4>> joints;
    joints.reserve(scene.skins.size());
    for (const ImportedSkin& skin : scene.skins) joints.push_back(rest_joints(scene, skin));
    for (const ImportedInstance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (instance.skin)
            append(posed(mesh, joints.at(*instance.skin)), glm::mat4(1.0F), instance.name, merged);
        else
            append(mesh, instance.transform, instance.name, merged);
    }
    return merged;
}

}  // namespace rowland::scene
