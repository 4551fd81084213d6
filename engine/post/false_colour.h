#pragma once

#include <glm/vec3.hpp>

namespace rowland::post {

constexpr double false_colour_stops = 6.5;  ///< the scale ends this far below and above 0.18

/// A colour for each whole stop of luminance from 0.18: linear Rec.709. Grey: 0.18; blues to black: darker; greens,
/// yellow, orange, red, white: brighter. Beyond the scale as at its ends.
glm::dvec3 false_colour(double stops);

}  // namespace rowland::post
