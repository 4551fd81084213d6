#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "engine/scene/mesh.h"

namespace rowland::scene {

/// A profile turned around the Y axis: stands, rims, rings, shells. The outside is to the right of someone who walks
/// along the profile with the axis to the left and up ahead, so an outer wall goes up and a top goes inward.
struct LatheRecipe {
    /// Where the tangent points.
    enum class Tangent {
        Around,  ///< along growing longitude (+X towards −Z); u = share of the turn, v = share of the profile's length
        Along,   ///< along the profile; u = share of its length, v = 1 − share of the turn
    };

    /// [radius, height] in metres, at least two, neighbours apart; a radius of 0 only at the ends.
    std::vector<glm::dvec2> profile;
    /// A curve through the points, instead of straight lines with edges between them. It meets the axis at a right
    /// angle.
    bool smooth = false;
    int steps = 8;          ///< of a smooth curve between two points, 1 … 256
    int segments = 128;     ///< sectors, 3 … 2048
    double from_deg = 0.0;  ///< longitudes: 0 <= from_deg < to_deg <= 360
    double to_deg = 360.0;
    double flatten = 1.0;  ///< factor on Z, > 0: round becomes elliptic
    Tangent tangent = Tangent::Around;
};

/// Straight lines: each gives (segments + 1) vertices at either end, `segments` where it meets the axis.
Mesh build_lathe(const LatheRecipe& recipe);

}  // namespace rowland::scene
