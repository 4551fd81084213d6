#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <stop_token>
#include <vector>

#include "engine/lighting/light_samples.h"

namespace rowland::diffraction {

/// Levels of a streak map. Each doubles the lobe's length and halves the texels of every axis.
inline constexpr int kStreakLevels = 3;

struct StreakMapSize {
    int side = 320;        ///< texels of a chart's side, a multiple of 4
    int directions = 16;   ///< texels over the directions of the lobe, a multiple of 4
    double length = 0.05;  ///< deviation along the lobe at level 0, in radians

    /// Deviation across the lobe at level 0 in radians, interpolation included: about that of a node in s_g.
    double width() const { return 3.84 / side; }
};

/// A probe blurred to a narrow lobe: linear RGB over the direction s and over the tangent t along which it is blurred
/// (PHYSICS (6.8)). It depends on the lobe's length alone; objects and gratings do not matter. A volume texture with
/// levels, GL_LINEAR_MIPMAP_LINEAR:
///   chart 0 holds the upper half (s_y ≥ 0), chart 1 the lower, mirrored; both side by side, with a rim beyond the
///   equator; stereographic: p = (s_x, s_z)/(1 + |s_y|)
///   texture s = ½ (chart + ½ + p_x · kStreakChartScale), t = ½ + p_y · kStreakChartScale
///   r: the chart keeps angles; for (a, b) = the image of t with b ≥ 0, r = ½ − ½ a/(|a| + b), GL_REPEAT
///   level: log2 of the lobe's length over that of level 0
struct StreakMap {
    StreakMapSize size;
    std::array<std::vector<glm::vec3>, kStreakLevels> levels;  ///< see index()

    int rows(int level) const { return size.side >> level; }
    int columns(int level) const { return 2 * rows(level); }
    int slices(int level) const { return size.directions >> level; }
    std::size_t index(int level, int slice, int row, int column) const {
        const auto u = [](int i) { return static_cast<std::size_t>(i); };
        return (u(slice) * u(rows(level)) + u(row)) * u(columns(level)) + u(column);
    }
};

/// Texture coordinates per chart coordinate.
inline constexpr double kStreakChartScale = 0.5 / 1.1;
/// Least 1 + |s_y| of a chart's rim.
inline constexpr double kStreakRim = 0.905;

/// Where a map is looked up.
struct StreakPosition {
    glm::dvec3 texture{0.0};
    double level = 0.0;
};

/// The texture coordinates of a lobe, at level 0. `direction`: of unit length; `along`: a tangent there, of any length.
/// `chart`: 0 or 1. World axes.
StreakPosition streak_position(const glm::dvec3& direction, const glm::dvec3& along, int chart);

/// Fills the map from a probe's texels. Uses all cores; the result does not depend on their number. After a stop
/// request it returns early with an unusable map.
StreakMap fill_streak_map(const lighting::LightSamples& texels, const StreakMapSize& size,
                          const std::stop_token& stop = {});

/// Linear RGB, as texture units interpolate.
glm::dvec3 sample(const StreakMap& map, const StreakPosition& position);

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
