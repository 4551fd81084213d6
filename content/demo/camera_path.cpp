#include "content/demo/camera_path.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace rowland::demo {

scene::Camera flight(const scene::Camera& start, double share) {
    const double turn = 2.0 * std::numbers::pi * share;
    const glm::dvec3 offset(start.eye - start.target);
    const double distance = glm::length(offset);
    const double height = std::asin(offset.y / distance);
    const double azimuth = std::atan2(offset.x, offset.z) + turn;
    // A sine that is 0 at both ends and changes sign in between.
    constexpr double kLowest = 0.05;
    const double pitch = height + (height > kLowest ? height - kLowest : 0.0) * std::sin(turn);
    scene::Camera camera = start;
    camera.eye = start.target + glm::vec3(distance * glm::dvec3(std::sin(azimuth) * std::cos(pitch), std::sin(pitch),
                                                                std::cos(azimuth) * std::cos(pitch)));
    return camera;
}

}  // namespace rowland::demo
