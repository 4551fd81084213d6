#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>

namespace rowland::lighting {

/// Unit vector at an azimuth (0 = −Z, growing toward +X) and an elevation above the horizon, in radians.
inline glm::dvec3 direction_at(double azimuth, double elevation) {
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), -std::cos(elevation) * std::cos(azimuth)};
}

/// Unit vector through a point, in texels, of an equirectangular image of `width` × `width`/2 texels (PHYSICS §1).
inline glm::dvec3 equirectangular_direction(double x, double y, int width) {
    const double azimuth = 2 * std::numbers::pi * (x / width - 0.5);
    const double elevation = std::numbers::pi * (0.5 - 2 * y / width);
    return direction_at(azimuth, elevation);
}

}  // namespace rowland::lighting
