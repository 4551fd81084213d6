#pragma once

#include "engine/lighting/probe_image.h"

namespace rowland::trade {

/// What makes a probe easy or hard to shade with.
struct ProbeStatistics {
    int width = 0;  ///< texels
    int height = 0;
    double mean = 0.0;                ///< luminance over the sphere, in the image's unit
    double peak_over_mean = 0.0;      ///< of luminance; 0 if the probe is black
    double brightest_fraction = 0.0;  ///< of the light, from the brightest thousandth of the sphere
};

ProbeStatistics statistics_of(const lighting::ProbeImage& probe);

}  // namespace rowland::trade
