#include "content/demo/play/hand.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "content/demo/play/body.h"
#include "engine/core/check.h"

namespace rowland::demo {

namespace {

constexpr double kVelocityTimeConstant_s = 0.05;  ///< mice report less often than we step
constexpr double kMinBallRadius_px = 40;          ///< so that a short drag does not spin a small object fast
constexpr double kWheelPush = 3.0;                ///< radians per second, per notch

/// A node's rotation to the world, without the scales.
glm::dquat rotation_to_world(ecs::World& world, ecs::Entity node) {
    glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
    for (; world.alive(node); node = parent_of(world, node))
        if (const auto* transform = world.find<scene::Transform>(node))
            rotation = glm::dquat(transform->rotation) * rotation;
    return glm::normalize(rotation);
}

glm::dvec3 clamp_spin(const glm::dvec3& spin) {
    const double speed = glm::length(spin);
    return speed > kFastestSpin ? spin * (kFastestSpin / speed) : spin;
}

}  // namespace

Hand::Hand(ecs::World& world, std::size_t index, Body& body, const glm::vec3& point, const scene::Camera& camera,
           int window_height)
    : index_(index) {
    ROWLAND_CHECK_OP(window_height, >=, 1);
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target - camera.eye));
    right_ = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
    up_ = glm::cross(right_, forward);
    const double depth = std::max(1e-6, glm::dot(glm::dvec3(point - camera.eye), forward));
    metres_per_pixel_ = 2.0 * depth * std::tan(0.5 * static_cast<double>(camera.vertical_field_of_view)) /
                        static_cast<double>(window_height);
    radius_ = std::max(static_cast<double>(body.radius), kMinBallRadius_px * metres_per_pixel_);
    const glm::vec3 centre = glm::vec3(object_to_world(world, body.node) * glm::vec4(body.centre, 1.0F));
    grab_offset_ = glm::inverse(rotation_to_world(world, body.node)) * glm::dvec3(point - centre);
    body.state.touched = true;
    body.state.spin = glm::dvec3(0.0);
}

glm::dvec3 Hand::trackball_rotation(const glm::dvec2& drag) const {
    return (drag.y * right_ + drag.x * up_) * (metres_per_pixel_ / radius_);
}

glm::dvec3 Hand::own_axis_rotation(const Body& body, const glm::dvec2& drag, const glm::dquat& to_world) const {
    const glm::dvec3 axis = to_world * own_axis(body);
    const glm::dvec3 arm = to_world * (rotation_of(body) * grab_offset_);
    const glm::dvec3 motion = (drag.x * right_ - drag.y * up_) * metres_per_pixel_;
    const glm::dvec3 tangent = glm::cross(axis, arm);  // velocity of the grabbed point per radian
    // Near the axis a short drag would be a large angle.
    const double shortest = 0.3 * radius_;
    return axis * (glm::dot(motion, tangent) / std::max(glm::dot(tangent, tangent), shortest * shortest));
}

void Hand::move(ecs::World& world, Body& body, const HandMove& move, double seconds) {
    const glm::dquat to_world = rotation_to_world(world, parent_of(world, body.node));
    const glm::dvec2 drag(move.drag);
    glm::dvec3 turned(0.0);  // radians, world
    if (drag != glm::dvec2(0.0)) {
        turned = move.about_own_axis ? own_axis_rotation(body, drag, to_world) : trackball_rotation(drag);
        if (!move.about_own_axis) body.state.raised = true;
    }
    const glm::dvec3 in_parent = glm::inverse(to_world) * turned;
    if (const double angle = glm::length(in_parent); angle > 0.0) turn(body, glm::angleAxis(angle, in_parent / angle));
    velocity_ += (in_parent / seconds - velocity_) * -std::expm1(-seconds / kVelocityTimeConstant_s);
    if (move.wheel != 0.0F)
        body.state.spin = clamp_spin(body.state.spin + own_axis(body) * (kWheelPush * static_cast<double>(move.wheel)));
}

void Hand::let_go(Body& body) const {
    constexpr double kStill = 0.3;  // radians per second: a resting hand trembles
    if (glm::length(velocity_) > kStill) body.state.spin = clamp_spin(body.state.spin + velocity_);
}

}  // namespace rowland::demo
