#include "engine/scene/view_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rowland::scene {

glm::vec3 direction_of(ViewAngles angles) {
    const double level = std::cos(angles.pitch);
    return glm::vec3(glm::dvec3(level * std::sin(angles.yaw), std::sin(angles.pitch), level * std::cos(angles.yaw)));
}

ViewAngles angles_of(glm::vec3 direction) {
    // In double, where no float overflows when squared.
    const glm::dvec3 d(direction);
    const double level = std::hypot(d.x, d.z);
    if (!std::isfinite(level) || !std::isfinite(d.y)) return {};
    return {.yaw = std::atan2(d.x, d.z), .pitch = std::clamp(std::atan2(d.y, level), -kMaximumPitch, kMaximumPitch)};
}

ViewAngles turned(ViewAngles angles, double yaw, double pitch) {
    if (!std::isfinite(yaw)) yaw = 0.0;
    if (!std::isfinite(pitch)) pitch = 0.0;
    return {.yaw = std::remainder(angles.yaw + yaw, 2.0 * std::numbers::pi),
            .pitch = std::clamp(angles.pitch + pitch, -kMaximumPitch, kMaximumPitch)};
}

}  // namespace rowland::scene
