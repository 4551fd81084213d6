#pragma once

#include <glm/vec3.hpp>

#include "modules/diffraction/representations/streak/streak_map.h"

namespace rowland::diffraction {

/// Least s_n² of a lobe's middle.
inline constexpr double kLeastSquare = 1e-4;

/// Light that a node sees: a lobe about `direction`. World axes.
struct LobePoint {
    glm::dvec3 direction{0.0, 0.0, 1.0};  ///< of unit length
    glm::dvec3 along{1.0, 0.0, 0.0};      ///< tangent along which the lobe is long, of any length
    double level = 0.0;                   ///< in the map
};

/// Where the nodes of a segment are in the map: the parabola in the chart through both ends and the middle. The lobe's
/// direction is linear between the ends; chart and level are the middle's.
class StreakPath {
 public:
    /// The points at `low`, ½ (low + high) and `high` of the segment's coordinate.
    StreakPath(double low, double high, const LobePoint& before, const LobePoint& centre, const LobePoint& after);

    StreakPosition at(double x) const;

 private:
    double middle_;
    double scale_;  ///< makes the ends −1 and 1
    double level_;
    glm::dvec3 mean_{0.0};
    glm::dvec3 slope_{0.0};
    glm::dvec3 bend_{0.0};
};

}  // namespace rowland::diffraction
