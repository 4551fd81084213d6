#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/scene/mesh.h"
#include "engine/scene/transform.h"

namespace rowland::scene {

enum class AnimatedProperty { Translation, Rotation, Scale };
enum class Interpolation { Step, Linear, CubicSpline };

/// One property of one node over time (glTF 2.0, 3.11).
struct AnimationChannel {
    std::size_t node = 0;
    AnimatedProperty property = AnimatedProperty::Translation;
    Interpolation interpolation = Interpolation::Linear;
    std::vector<float> times_s;     ///< strictly ascending, not empty
    std::vector<glm::vec4> values;  ///< one per key (xyz, or a quaternion xyzw); CubicSpline: in-tangent, value and
                                    ///< out-tangent of every key
};

struct Animation {
    std::string name;
    std::vector<AnimationChannel> channels;
    float duration_s = 0.0F;  ///< the last key's time
};

/// A channel's value at a time, constant before the first and after the last key. Rotations are returned as unit
/// quaternions; linear ones are interpolated along the shorter arc (glTF 2.0, appendix C).
glm::vec4 sample(const AnimationChannel& channel, float time_s);

/// Writes the animated properties into `nodes` (indexed by AnimationChannel::node).
void pose(const Animation& animation, float time_s, std::span<Transform> nodes);

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
