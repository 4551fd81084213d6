#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "content/demo/play/body.h"
#include "engine/ecs/world.h"
#include "engine/scene/camera.h"

namespace rowland::demo {

/// The mouse's input to a held body during one step.
struct HandMove {
    glm::vec2 drag{0.0F};  ///< screen coordinates, x right and y down
    float wheel = 0.0F;    ///< notches
    bool about_own_axis = false;
};

/// Holds one body. A drag turns it like a ball whose near side the cursor holds: about the axis in the picture's plane
/// perpendicular to the drag; or about its own axis, so that the grabbed point stays under the cursor. Released in
/// motion, it keeps the hand's velocity, averaged exponentially with a time constant of 0.05 s.
class Hand {
 public:
    /// Grabs `body` at `point` (world), seen by `camera` in a window of that height.
    Hand(ecs::World& world, std::size_t index, Body& body, const glm::vec3& point, const scene::Camera& camera,
         int window_height);

    std::size_t body() const { return index_; }
    /// Applies the input of one step of `seconds` > 0.
    void move(ecs::World& world, Body& body, const HandMove& move, double seconds);
    void let_go(Body& body) const;

 private:
    glm::dvec3 trackball_rotation(const glm::dvec2& drag) const;
    glm::dvec3 own_axis_rotation(const Body& body, const glm::dvec2& drag, const glm::dquat& to_world) const;

    std::size_t index_;
    glm::dvec3 right_;             ///< of the picture, world
    glm::dvec3 up_;                ///< of the picture, world
    double metres_per_pixel_;      ///< at the grabbed point
    double radius_;                ///< of the ball, metres
    glm::dvec3 grab_offset_{0.0};  ///< centre to grabbed point, in the body's axes and the world's lengths
    glm::dvec3 velocity_{0.0};     ///< radians per second in the parent's axes, averaged
};

}  // namespace rowland::demo
