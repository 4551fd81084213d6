#include "engine/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "engine/core/check.h"

namespace rowland::scene {

namespace {

constexpr glm::vec3 kUp{0.0F, 1.0F, 0.0F};

template <typename Vector>
Vector finite_or_zero(Vector v) {
    for (int i = 0; i < v.length(); ++i)
        if (!std::isfinite(v[i])) return Vector(0);
    return v;
}

/// `move` limited to length 1, so that two keys are not faster than one.
glm::vec3 cut_to_one(glm::vec3 move) {
    const float length = glm::length(move);
    return length > 1.0F ? move / length : move;
}

}  // namespace

glm::mat4 Camera::view() const {
    return glm::lookAt(eye, target, up);
}

glm::mat4 Camera::projection(float aspect) const {
    return glm::perspective(vertical_field_of_view, aspect, near_plane, far_plane);
}

Camera framed(Camera camera, const glm::vec3& target, float radius) {
    constexpr float kMargin = 1.1F;
    const glm::vec3 backward = glm::normalize(camera.eye - camera.target);
    camera.target = target;
    camera.eye = target + kMargin * radius / std::sin(0.5F * camera.vertical_field_of_view) * backward;
    return camera;
}

glm::vec3 direction_of(ViewAngles angles) {
    const double horizontal = std::cos(angles.pitch);
    return glm::vec3(
        glm::dvec3(horizontal * std::sin(angles.yaw), std::sin(angles.pitch), horizontal * std::cos(angles.yaw)));
}

ViewAngles angles_of(glm::vec3 direction) {
    // In double, where no float overflows when squared.
    const glm::dvec3 d(direction);
    const double horizontal = std::hypot(d.x, d.z);
    if (!std::isfinite(horizontal) || !std::isfinite(d.y)) return {};
    return {.yaw = std::atan2(d.x, d.z),
            .pitch = std::clamp(std::atan2(d.y, horizontal), -kMaximumPitch, kMaximumPitch)};
}

ViewAngles turned(ViewAngles angles, double yaw, double pitch) {
    if (!std::isfinite(yaw)) yaw = 0.0;
    if (!std::isfinite(pitch)) pitch = 0.0;
    return {.yaw = std::remainder(angles.yaw + yaw, 2.0 * std::numbers::pi),
            .pitch = std::clamp(angles.pitch + pitch, -kMaximumPitch, kMaximumPitch)};
}

OrbitCamera::OrbitCamera(const Camera& start, OrbitSettings settings) : settings_(settings), lens_(start) {
    ROWLAND_CHECK_OP(settings.minimum_distance, >, 0.0F);
    ROWLAND_CHECK_OP(settings.maximum_distance, >=, settings.minimum_distance);
    const glm::vec3 offset = start.eye - start.target;
    const float distance = glm::length(offset);
    angles_ = angles_of(offset);
    distance_ = std::isfinite(distance) ? std::clamp(distance, settings.minimum_distance, settings.maximum_distance)
                                        : settings.minimum_distance;
    lens_.target = finite_or_zero(lens_.target);
    lens_.up = kUp;
}

void OrbitCamera::update(const OrbitInput& input) {
    // The scene follows the drag: to the right moves the eye to the left, down raises it.
    const double scale = settings_.radians_per_pixel;
    angles_ = turned(angles_, -scale * input.drag.x, scale * input.drag.y);
    if (!std::isfinite(input.scroll)) return;
    const double zoomed = distance_ * std::exp(-static_cast<double>(settings_.zoom_per_notch) * input.scroll);
    // Clamped in double: many notches at once may leave the range of float.
    distance_ = static_cast<float>(std::clamp(zoomed, static_cast<double>(settings_.minimum_distance),
                                              static_cast<double>(settings_.maximum_distance)));
}

Camera OrbitCamera::camera() const {
    Camera camera = lens_;
    camera.eye = camera.target + distance_ * direction_of(angles_);
    return camera;
}

FlyCamera::FlyCamera(const Camera& start, FlySettings settings)
    : settings_(settings), lens_(start), position_(finite_or_zero(start.eye)) {
    ROWLAND_CHECK_OP(settings.response_s, >, 0.0F);
    angles_ = angles_of(start.target - start.eye);
}

glm::vec3 FlyCamera::wanted_velocity(const FlyInput& input) const {
    const glm::vec3 forward = direction_of(angles_);
    // The pitch never reaches a pole, so the cross product has a length.
    const glm::vec3 right = glm::normalize(glm::cross(forward, kUp));
    const glm::vec3 move = cut_to_one(finite_or_zero(input.move));
    const float factor = (input.fast ? settings_.fast_factor : 1.0F) * (input.slow ? settings_.slow_factor : 1.0F);
    return settings_.speed_m_per_s * factor * (move.x * right + move.y * kUp + move.z * forward);
}

void FlyCamera::update(const FlyInput& input, double seconds) {
    if (!std::isfinite(seconds) || seconds < 0.0) seconds = 0.0;
    // Yaw grows towards +X, which is to the left of +Z with +Y up. A mouse moved down looks down, a stick pushed up
    // looks up. Half of the turn is applied before the move and half after: second order in the frame's length.
    const glm::dvec2 by_mouse =
        static_cast<double>(settings_.radians_per_pixel) * glm::dvec2(finite_or_zero(input.look));
    const glm::dvec2 by_stick =
        seconds * static_cast<double>(settings_.turn_radians_per_s) * glm::dvec2(finite_or_zero(input.turn));
    const double half_yaw = -0.5 * (by_mouse.x + by_stick.x);
    const double half_pitch = 0.5 * (by_stick.y - by_mouse.y);
    angles_ = turned(angles_, half_yaw, half_pitch);
    // dv/dt = (wanted - v) / response, solved exactly over the frame.
    const glm::dvec3 wanted = wanted_velocity(input);
    const double response = settings_.response_s;
    const double decayed = -std::expm1(-seconds / response);  // fraction of the difference to `wanted`
    position_ += wanted * seconds + (velocity_ - wanted) * (response * decayed);
    velocity_ += (wanted - velocity_) * decayed;
    if (settings_.room) stay_in(*settings_.room);
    angles_ = turned(angles_, half_yaw, half_pitch);
}

void FlyCamera::stay_in(const Bounds& room) {
    const glm::dvec3 inside = glm::clamp(position_, glm::dvec3(room.minimum), glm::dvec3(room.maximum));
    for (int axis = 0; axis < 3; ++axis)
        if (inside[axis] != position_[axis]) velocity_[axis] = 0.0;
    position_ = inside;
}

Camera FlyCamera::camera() const {
    Camera camera = lens_;
    camera.eye = position();
    camera.target = camera.eye + direction_of(angles_);
    camera.up = kUp;
    return camera;
}

}  // namespace rowland::scene
