#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "engine/scene/mesh.h"

namespace rowland::scene {

/// A profile turned around the Y axis: stands, rims, rings, shells. In the (radius, height) plane the outside is to the
/// right of the profile's direction, so an outer wall goes up and a top goes inward.
struct LatheRecipe {
    enum class Tangent {
        Around,  ///< along growing longitude (+X towards −Z); u = fraction of the turn, v = fraction of the profile
        Along,   ///< along the profile; u = fraction of its length, v = 1 − fraction of the turn
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

/// Sphere around the origin, poles on ±Y. The tangent points along growing longitude (+X towards −Z); u = longitude /
/// 2π, v grows linearly with latitude from the south to the north pole.
struct SphereRecipe {
    double radius = 0.0;  ///< metres, > 0
    int rings = 64;       ///< bands of latitude, 2 … 2048
    int segments = 128;   ///< sectors of longitude, 3 … 2048
};

/// Straight lines: each gives (segments + 1) vertices at either end, `segments` where it meets the axis.
Mesh build_lathe(const LatheRecipe& recipe);

/// A lathe whose profile is a meridian with exact normals.
Mesh build_sphere(const SphereRecipe& recipe);

}  // namespace rowland::scene
