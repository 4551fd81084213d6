#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "engine/ecs/world.h"
#include "engine/scene/transform.h"

namespace rowland::demo {

/// Time constant with which a thrown object slows down, seconds.
inline constexpr double kSpinDecay_s = 2.5;
/// The fastest spin, radians per second: at 60 frames per second a faster one would seem to stand still.
inline constexpr double kFastestSpin = 40.0;

/// What the play has changed of a body. Vectors and rotations are in the axes of its node's parent.
struct BodyState {
    glm::dquat turned{1.0, 0.0, 0.0, 0.0};  ///< about its centre, from rest
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
    double idle_spin = 0.0;              ///< by which it turns about its axis until touched, radians per second
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
/// Rises or comes down for `seconds`, also while the play is paused.
void step_lift(Body& body, double seconds);

/// The present transform of its node. `up`: the world's +Y in the axes and lengths of the node's parent.
scene::Transform transform_of(const Body& body, const glm::vec3& up);

/// Sets the Transform of its node.
void update_node(ecs::World& world, const Body& body);

}  // namespace rowland::demo
