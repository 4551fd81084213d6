#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"
#include "engine/scene/view_angles.h"

namespace rowland::scene {

struct FlySettings {
    float radians_per_pixel = 0.003F;  ///< of mouse movement
    float turn_radians_per_s = 2.0F;   ///< of a stick at full travel
    float speed_m_per_s = 1.0F;
    float fast_factor = 4.0F;         ///< on the speed, while `fast` is held
    float slow_factor = 0.25F;        ///< on the speed, while `slow` is held
    float response_s = 0.06F;         ///< time constant of the speed, > 0
    std::optional<Bounds> room = {};  ///< the eye stays inside; nullopt: unbounded
};

/// What the user does during one frame.
struct FlyInput {
    glm::vec3 move{0.0F};  ///< x right (D - A), y up (E - Q, the world's up), z forward (W - S); cut to length 1
    glm::vec2 look{0.0F};  ///< mouse movement during the frame, pixels, x right and y down
    glm::vec2 turn{0.0F};  ///< stick, -1 to 1, x right and y up
    bool fast = false;     ///< Shift
    bool slow = false;     ///< Ctrl
};

/// A camera that flies, +Y up, always upright: the pitch ends short of the poles. The velocity follows the input with a
/// time constant, solved exactly for constant input, so the path does not depend on the frame rate; only while the view
/// turns does the frame length enter, to second order. Input that is not finite is ignored.
class FlyCamera {
 public:
    /// Starts at `start`, whose lens (field of view, near and far plane) it keeps.
    explicit FlyCamera(const Camera& start, FlySettings settings = {});

    /// `seconds` long; a negative or non-finite time counts as none.
    void update(const FlyInput& input, double seconds);
    /// Its target is one metre ahead.
    Camera camera() const;

    glm::vec3 position() const { return position_; }
    glm::vec3 velocity() const { return velocity_; }  ///< metres per second
    double yaw() const { return angles_.yaw; }      ///< radians, -pi to pi; 0 looks along +Z, growing turns towards +X
    double pitch() const { return angles_.pitch; }  ///< radians; growing looks up

 private:
    glm::vec3 wanted_velocity(const FlyInput& input) const;
    /// Slides along its walls.
    void stay_in(const Bounds& room);

    FlySettings settings_;
    Camera lens_;  ///< its field of view and planes are used
    glm::dvec3 position_{0.0};
    glm::dvec3 velocity_{0.0};
    ViewAngles angles_;
};

}  // namespace rowland::scene
