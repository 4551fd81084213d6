#include "engine/scene/skin.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "engine/core/check.h"
#include "engine/scene/tangents.h"
#include "engine/scene/transform.h"

namespace rowland::scene {

namespace {

/// The vertex's matrix: its joints' blended by its weights.
glm::mat4 blend(const glm::u16vec4& joints, const glm::vec4& weights, std::span<const glm::mat4> matrices) {
    glm::mat4 blended(0.0F);
    for (int i = 0; i < 4; ++i) {
        // A slot that is not used may name any joint, whose matrix may overflow.
        if (weights[i] == 0.0F) continue;
        ROWLAND_CHECK_OP(joints[i], <, matrices.size());
        blended += weights[i] * matrices[joints[i]];
    }
    return blended;
}

/// det(m) times the inverse transpose with the determinant's sign taken out: carries normals, mirrored or not.
glm::mat3 normal_matrix(const glm::mat3& m) {
    const glm::mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::dot(cofactors[0], m[0]) < 0.0F ? -1.0F * cofactors : cofactors;
}

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& fallback) {
    const double length = glm::length(glm::dvec3(v));
    return length > 0.0 && std::isfinite(length) ? glm::vec3(glm::dvec3(v) / length) : fallback;
}

}  // namespace

std::vector<glm::mat4> joint_matrices(ecs::World& world, const Skin& skin) {
    ROWLAND_CHECK_OP(skin.joints.size(), ==, skin.inverse_bind.size());
    std::vector<glm::mat4> matrices;
    matrices.reserve(skin.joints.size());
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
        const WorldMatrix* joint = world.find<WorldMatrix>(skin.joints[i]);
        matrices.push_back(joint ? joint->matrix * skin.inverse_bind[i] : skin.inverse_bind[i]);
    }
    return matrices;
}

Mesh posed(const Mesh& mesh, std::span<const glm::mat4> joints) {
    ROWLAND_CHECK_OP(mesh.joints.size(), ==, mesh.positions.size());
    ROWLAND_CHECK_OP(mesh.weights.size(), ==, mesh.positions.size());
    Mesh result = mesh;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::mat4 matrix = blend(mesh.joints[i], mesh.weights[i], joints);
        const glm::mat3 linear(matrix);
        result.positions[i] = glm::vec3(matrix * glm::vec4(mesh.positions[i], 1.0F));
        result.normals[i] = unit_or(normal_matrix(linear) * mesh.normals[i], mesh.normals[i]);
        const bool mirrored = glm::dot(glm::cross(linear[0], linear[1]), linear[2]) < 0.0F;
        const float w = mirrored ? -mesh.tangents[i].w : mesh.tangents[i].w;
        result.tangents[i] = glm::vec4(linear * glm::vec3(mesh.tangents[i]), w);
        orthonormalise_tangent(result.tangents[i], result.normals[i]);
    }
    return result;
}

}  // namespace rowland::scene
