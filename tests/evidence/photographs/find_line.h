#pragma once

#include <span>
#include <vector>

#include "tests/evidence/photographs/bench.h"

namespace rowland::evidence {

/// A maximum of samples.
struct Peak {
    double position = 0.0;  ///< in samples: the centroid of what exceeds half of the maximum
    double excess = 0.0;    ///< sum of that excess
};

/// The maxima of at least `threshold` that no sample within `apart` exceeds, in falling order. `around`: the samples
/// are those of a circle. On a line, a maximum that is cut off by an end above half of its height is left out.
std::vector<Peak> peaks(std::span<const double> samples, double threshold, int apart, bool around);

/// Where the samples lie that a picture is searched at, metres from the disc's centre: on its recorded part.
inline constexpr double kInnermost_m = 0.0245;
inline constexpr double kOutermost_m = 0.0585;
inline constexpr double kRadiusStep_m = 0.0005;

/// A bright line's crossing of a circle of the disc, as found in a picture alone.
struct Crossing {
    double azimuth = 0.0;
    double brightness = 0.0;  ///< across the line
};
std::vector<Crossing> find_crossings(const DrawnPicture& picture, double radius_m, double threshold);

/// The middle of a bright spot on a line.
struct Spot {
    double radius_m = 0.0;
    double azimuth = 0.0;
};
/// The spots that are complete, of at least `threshold`.
std::vector<Spot> find_spots(const DrawnPicture& picture, double threshold);

}  // namespace rowland::evidence
