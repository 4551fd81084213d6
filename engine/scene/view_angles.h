#pragma once

#include <glm/vec3.hpp>
#include <numbers>

namespace rowland::scene {

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

}  // namespace rowland::scene
