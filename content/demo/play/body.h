#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "engine/ecs/world.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"
#include "engine/scene/ray.h"
#include "engine/scene/transform.h"

namespace rowland::demo {

/// Null (never alive) at the top of the hierarchy.
ecs::Entity parent_of(ecs::World& world, ecs::Entity entity);

/// Object to world, from the present transforms: needs no update_world_matrices().
glm::mat4 object_to_world(ecs::World& world, ecs::Entity entity);

/// The name of an object: that of the nearest node at or above it that has one; else "grating".
std::string name_of_object(ecs::World& world, ecs::Entity entity);

/// Time constant with which a thrown object slows down, seconds.
inline constexpr double kSpinDecay_s = 2.5;
/// The fastest spin, radians per second: at 60 frames per second a faster one would seem to stand still.
inline constexpr double kFastestSpin = 40.0;

/// What the play has changed of a body. Vectors and rotations are in the axes of its node's parent.
struct BodyState {
    glm::dquat turned{1.0, 0.0, 0.0, 0.0};  ///< rotation about its centre, from rest
    glm::dvec3 spin{0.0};                   ///< angular velocity, radians per second
    double idle_s = 0.0;                    ///< time for which it has turned by itself
    bool touched = false;                   ///< was grabbed: it no longer turns by itself
    bool raised = false;                    ///< lifted off what it lies on, to turn freely
    double lift = 0.0;                      ///< fraction of its clearance by which it is lifted, 0 to 1

    friend bool operator==(const BodyState&, const BodyState&) = default;
};

/// An object that turns by itself about its own axis, by hand, or because it was thrown.
struct Body {
    ecs::Entity node;
    std::string name;                    ///< identifies it after its file is reloaded
    scene::Transform rest;               ///< of the node
    glm::vec3 centre{0.0F};              ///< about which it turns, in the node's space
    float radius = 0.0F;                 ///< of its bounding sphere about `centre`, metres in the world
    float clearance = 0.0F;              ///< how far it must be lifted to turn freely, metres in the world
    std::optional<glm::vec3> spin_axis;  ///< unit, in the node's space; none: +Y when pushed, and no idle turning
    double idle_spin = 0.0;              ///< angular velocity about its axis until touched, radians per second
    bool grab = false;                   ///< may be grabbed
    BodyState state;
};

/// Its node's rotation, relative to its parent.
glm::dquat rotation_of(const Body& body);
/// The axis about which it spins when pushed: its spin axis, or +Y, in its parent's axes and present pose; unit.
glm::dvec3 own_axis(const Body& body);

/// Turns it by a small rotation, given in its parent's axes.
void turn(Body& body, const glm::dquat& rotation);

/// One step of `seconds`: idle turning, and the spin of a thrown body, whose decay is solved exactly, so that the
/// result hardly depends on the step's length.
void step(Body& body, double seconds);
/// Raises or lowers it for `seconds`; called also while the play is paused.
void step_lift(Body& body, double seconds);

/// The present transform of its node. `up`: the world's +Y in the axes and lengths of the node's parent.
scene::Transform transform_of(const Body& body, const glm::vec3& up);

/// Sets the Transform of its node.
void update_node(ecs::World& world, const Body& body);

using scene::Ray;
using scene::TriangleHit;

/// A mesh that a ray can hit.
struct PickTarget {
    ecs::Entity entity;
    std::shared_ptr<const scene::Mesh> mesh;
    scene::Bounds bounds;  ///< of the mesh
};

/// The nearest intersection of a ray with the targets.
struct Hit {
    std::size_t target = 0;
    TriangleHit triangle;   ///< its distance in metres
    glm::vec3 point{0.0F};  ///< world
};

/// The nearest hit among the targets that are alive; nullopt if the ray misses all.
std::optional<Hit> pick(ecs::World& world, std::span<const PickTarget> targets, const Ray& ray);

}  // namespace rowland::demo
