#include "content/demo/play/camera_control.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "content/demo/play/action.h"

namespace rowland::demo {

namespace {

/// Metres per second: from eye to target in two seconds, within limits.
float walking_speed(const scene::Camera& start) {
    constexpr float kDistancesPerSecond = 0.5F;
    return std::clamp(kDistancesPerSecond * glm::length(start.target - start.eye), 0.02F, 2.0F);
}

float held(const platform::InputState& input, Held negative, Held positive) {
    return input.key_axis(key_of(negative), key_of(positive));
}

}  // namespace

CameraControl::CameraControl(const scene::Camera& start, const scene::Bounds& room)
    : start_(start), room_(room), orbit_(start) {}

void CameraControl::walk_from(const scene::Camera& camera) {
    walking_.emplace(camera, scene::FlySettings{.speed_m_per_s = walking_speed(start_), .room = room_});
}

void CameraControl::stop_at(const glm::vec3& eye) {
    scene::Camera camera = walking_->camera();
    camera.target += eye - camera.eye;
    camera.eye = eye;
    walk_from(camera);
}

void CameraControl::stop_walking(float distance) {
    scene::Camera camera = walking_->camera();
    camera.target = camera.eye + distance * glm::normalize(camera.target - camera.eye);
    orbit_ = scene::OrbitCamera(camera);
    walking_.reset();
}

void CameraControl::reset() {
    walking_.reset();
    orbit_ = scene::OrbitCamera(start_);
}

void CameraControl::step(const platform::InputState& input, double seconds, bool drags) {
    if (walking_)
        step_walk(input, seconds, drags);
    else
        step_orbit(input, seconds, drags);
}

void CameraControl::step_orbit(const platform::InputState& input, double seconds, bool drags) {
    glm::vec2 drag =
        glm::vec2(-input.right_stick().x, input.right_stick().y) * kStickPixelsPerSecond * static_cast<float>(seconds);
    constexpr float kPadNotchesPerSecond = 10.0F;
    float scroll = input.left_stick().y * kPadNotchesPerSecond * static_cast<float>(seconds);
    if (drags) {
        drag += glm::vec2(input.mouse_drag(platform::MouseButton::Left));
        scroll += static_cast<float>(input.scroll().y);
    }
    orbit_.update({.drag = drag, .scroll = scroll});
}

void CameraControl::step_walk(const platform::InputState& input, double seconds, bool drags) {
    const glm::vec2 stick = input.left_stick();
    walking_->update({.move = {held(input, Held::Left, Held::Right) + stick.x, held(input, Held::Down, Held::Up),
                               held(input, Held::Back, Held::Forward) + stick.y},
                      .look = drags ? glm::vec2(input.mouse_delta()) : glm::vec2(0.0F),
                      .turn = drags ? input.right_stick() : glm::vec2(0.0F),
                      .fast = input.key(key_of(Held::Fast)).down,
                      .slow = input.key(key_of(Held::Slow)).down},
                     seconds);
}

scene::Camera CameraControl::camera() const {
    return walking_ ? walking_->camera() : orbit_.camera();
}

}  // namespace rowland::demo
