#pragma once

#include <glm/vec3.hpp>
#include <numbers>

namespace rowland::scene {

/// Steepest pitch of the interactive cameras, 89 degrees: at the pole the +Y up vector says nothing.
constexpr double kMaximumPitch = 89.0 / 180.0 * std::numbers::pi;

/// A direction as radians, in double: a view turns by many small steps, whose rounding would add up in float.
struct ViewAngles {
    double yaw = 0.0;    ///< about +Y, 0 = +Z, growing towards +X; -pi to pi
    double pitch = 0.0;  ///< growing towards +Y; -kMaximumPitch to kMaximumPitch
};

/// The unit vector.
glm::vec3 direction_of(ViewAngles angles);

/// The angles of `direction` (any length), zero if it has none or is not finite; the pitch clamped.
ViewAngles angles_of(glm::vec3 direction);

/// `angles` turned by `yaw` and `pitch` radians, wrapped and clamped. A turn that is not finite counts as none.
ViewAngles turned(ViewAngles angles, double yaw, double pitch);

}  // namespace rowland::scene
