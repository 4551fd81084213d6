#include "engine/scene/skin.h"

#include "engine/core/check.h"
#include "engine/scene/tangents.h"
#include "engine/scene/transform.h"

namespace rowland::scene {

namespace {

/// The matrices of a vertex's joints, blended by its weights.
glm::mat4 blend(const glm::u16vec4& joints, const glm::vec4& weights, std::span<const glm::mat4> matrices) {
    glm::mat4 blended(0.0F);
    for (int i = 0; i < 4; ++i) {
        // The joint of an unused slot may have a matrix that overflows.
        if (weights[i] == 0.0F) continue;
        ROWLAND_CHECK_OP(joints[i], <, matrices.size());
        blended += weights[i] * matrices[joints[i]];
    }
    return blended;
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
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        transform_vertex(result, i, blend(mesh.joints[i], mesh.weights[i], joints));
    return result;
}

}  // namespace rowland::scene
