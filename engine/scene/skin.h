#pragma once

#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/scene/mesh.h"

namespace rowland::scene {

/// Component: an entity whose mesh follows a skeleton. Its own WorldMatrix must be the identity.
struct Skin {
    std::vector<ecs::Entity> joints;
    std::vector<glm::mat4> inverse_bind;  ///< one per joint
};

/// World matrix of each joint times its inverse bind matrix. Joints without a WorldMatrix are at the origin.
std::vector<glm::mat4> joint_matrices(ecs::World& world, const Skin& skin);

/// Linear blend skinning: positions, normals and tangents as the joints pose them, the CPU counterpart of the vertex
/// shader. The mesh must be skinned and its joints in range.
Mesh posed(const Mesh& mesh, std::span<const glm::mat4> joints);

}  // namespace rowland::scene
