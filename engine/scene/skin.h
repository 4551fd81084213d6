#pragma once

#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/scene/mesh.h"

namespace rowland::scene {

/// Component: an entity whose mesh follows a skeleton. Its own WorldMatrix must be the identity (the joints place it).
struct Skin {
    std::vector<ecs::Entity> joints;
    std::vector<glm::mat4> inverse_bind;  ///< as many
};

/// World matrix of each joint times its inverse bind matrix. Joints without a WorldMatrix count as standing at the
/// origin.
std::vector<glm::mat4> joint_matrices(ecs::World& world, const Skin& skin);

/// The mesh as the joints pose it: positions, normals and tangents are blended and those made unit; what the vertex
/// shader does, on the CPU. The mesh must be skinned and its joints in range.
Mesh posed(const Mesh& mesh, std::span<const glm::mat4> joints);

}  // namespace rowland::scene
