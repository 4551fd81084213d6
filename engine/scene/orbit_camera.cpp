#include "engine/scene/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/check.h"

namespace rowland::scene {

OrbitCamera::OrbitCamera(const Camera& start, OrbitSettings settings) : settings_(settings), lens_(start) {
    ROWLAND_CHECK_OP(settings.minimum_distance, >, 0.0F);
    ROWLAND_CHECK_OP(settings.maximum_distance, >=, settings.minimum_distance);
    const glm::vec3 offset = start.eye - start.target;
    const float distance = glm::length(offset);
    angles_ = angles_of(offset);
    distance_ = std::isfinite(distance) ? std::clamp(distance, settings.minimum_distance, settings.maximum_distance)
                                        : settings.minimum_distance;
    const glm::vec3& target = lens_.target;
    if (!std::isfinite(target.x) || !std::isfinite(target.y) || !std::isfinite(target.z)) {
        lens_.target = glm::vec3(0.0F);
    }
    lens_.up = glm::vec3(0.0F, 1.0F, 0.0F);
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

}  // namespace rowland::scene
