#pragma once

#include <optional>

#include "engine/platform/input.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"

namespace rowland::demo {

/// The user's camera: orbits about a point, or walks.
class CameraControl {
 public:
    /// Walking is confined to `room`.
    CameraControl(const scene::Camera& start, const scene::Bounds& room);

    bool walking() const { return walking_.has_value(); }
    void walk() { walk_from(orbit_.camera()); }
    /// Returns to orbiting, about the point `distance` metres in front of the eye.
    void stop_walking(float distance);
    void reset();
    /// Moves a walking camera to `eye`, in the axes of camera(), without velocity.
    void stop_at(const glm::vec3& eye);

    /// One step of `seconds`. `drags`: dragging moves the camera, not an object.
    void step(const platform::InputState& input, double seconds, bool drags);
    scene::Camera camera() const;

 private:
    void walk_from(const scene::Camera& camera);
    void step_orbit(const platform::InputState& input, double seconds, bool drags);
    void step_walk(const platform::InputState& input, double seconds, bool drags);

    scene::Camera start_;
    scene::Bounds room_;
    scene::OrbitCamera orbit_;
    std::optional<scene::FlyCamera> walking_;
};

}  // namespace rowland::demo
