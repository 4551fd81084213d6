#pragma once

#include <glm/vec2.hpp>

#include "engine/scene/camera.h"
#include "engine/scene/view_angles.h"

namespace rowland::scene {

struct OrbitSettings {
    float radians_per_pixel = 0.005F;  ///< of drag
    float zoom_per_notch = 0.1F;       ///< natural logarithm of the distance per notch of the wheel
    float minimum_distance = 0.02F;    ///< metres, > 0
    float maximum_distance = 1000.0F;  ///< metres
};

/// What the user did since the last update.
struct OrbitInput {
    glm::vec2 drag{0.0F};  ///< pixels, x right and y down
    float scroll = 0.0F;   ///< notches; positive zooms in
};

/// A camera that turns about a target, +Y up, always upright: the pitch ends short of the poles. The scene follows the
/// drag, and each notch of the wheel changes the distance by the same factor. Input that is not finite is ignored.
class OrbitCamera {
 public:
    /// Starts at `start`, whose target and lens (field of view, near and far plane) it keeps. A start without a
    /// direction (eye on the target, or not finite) looks along -Z from the smallest distance.
    explicit OrbitCamera(const Camera& start, OrbitSettings settings = {});

    void update(const OrbitInput& input);
    Camera camera() const;

    double yaw() const {
        return angles_.yaw;
    }  ///< radians, -pi to pi; 0 looks along -Z, growing moves the eye towards +X
    double pitch() const { return angles_.pitch; }  ///< radians; growing raises the eye
    float distance() const { return distance_; }    ///< metres

 private:
    OrbitSettings settings_;
    Camera lens_;  ///< its eye is not used
    ViewAngles angles_;
    float distance_ = 1.0F;
};

}  // namespace rowland::scene
