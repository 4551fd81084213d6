#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>

#include "engine/scene/mesh.h"

namespace rowland::scene {

/// A perspective camera that looks from `eye` at `target`. In world space, lengths in metres.
struct Camera {
    glm::vec3 eye{0.0F, 0.0F, 1.0F};
    glm::vec3 target{0.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    float vertical_field_of_view = 0.7F;  ///< radians
    float near_plane = 0.01F;
    float far_plane = 100.0F;

    glm::mat4 view() const;
    /// OpenGL clip space; `aspect` = width / height.
    glm::mat4 projection(float aspect) const;
};

/// Moves a camera so that it looks at `target` in the same direction, from where a sphere of `radius` about the target
/// fills the picture's height but for a margin of a tenth.
Camera framed(Camera camera, const glm::vec3& target, float radius);

/// Steepest pitch of the interactive cameras, 89 degrees: at the poles the up vector +Y gives no orientation.
constexpr double kMaximumPitch = 89.0 / 180.0 * std::numbers::pi;

/// A direction in radians; double, because a view turns by many small steps whose rounding adds up.
struct ViewAngles {
    double yaw = 0.0;    ///< about +Y, 0 = +Z, growing towards +X; -pi to pi
    double pitch = 0.0;  ///< growing towards +Y; -kMaximumPitch to kMaximumPitch
};

/// The unit vector.
glm::vec3 direction_of(ViewAngles angles);

/// The angles of `direction` (any length), with the pitch clamped; zeros if it is zero or not finite.
ViewAngles angles_of(glm::vec3 direction);

/// `angles` turned by `yaw` and `pitch` radians, wrapped and clamped. A turn that is not finite is ignored.
ViewAngles turned(ViewAngles angles, double yaw, double pitch);

struct OrbitSettings {
    float radians_per_pixel = 0.005F;  ///< of drag
    float zoom_per_notch = 0.1F;       ///< change of the distance's natural logarithm per notch of the wheel
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
/// time constant, solved exactly for constant input, so the path does not depend on the frame rate, except for an error
/// of second order in the frame's length while the view turns. Input that is not finite is ignored.
class FlyCamera {
 public:
    /// Starts at `start`, whose lens (field of view, near and far plane) it keeps.
    explicit FlyCamera(const Camera& start, FlySettings settings = {});

    /// Advances by a frame of `seconds`; a negative or non-finite time counts as zero.
    void update(const FlyInput& input, double seconds);
    /// Its target is one metre ahead.
    Camera camera() const;

    glm::vec3 position() const { return position_; }
    glm::vec3 velocity() const { return velocity_; }  ///< metres per second
    double yaw() const { return angles_.yaw; }      ///< radians, -pi to pi; 0 looks along +Z, growing turns towards +X
    double pitch() const { return angles_.pitch; }  ///< radians; growing looks up

 private:
    glm::vec3 wanted_velocity(const FlyInput& input) const;
    /// Keeps the position inside and removes the velocity into the walls, so that the eye slides along them.
    void stay_in(const Bounds& room);

    FlySettings settings_;
    Camera lens_;  ///< its field of view and planes are used
    glm::dvec3 position_{0.0};
    glm::dvec3 velocity_{0.0};
    ViewAngles angles_;
};

}  // namespace rowland::scene
