#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/math/spherical_harmonics.h"

namespace rowland::lighting {

class ProbeImage;

/// Light from all directions as raw radiance SH coefficients: linear Rec.709/D65 RGB, world axes, no window, no cosine,
/// no 1/π. Everything else (irradiance, windowed or rotated light) is derived from this.
struct ShLight {
    int bands = 0;
    std::vector<glm::dvec3> coefficients;  ///< bands², index l(l+1)+m
};

/// The light in exactly `bands` ≥ 1 bands: higher bands are dropped, missing ones are 0. The window spans the bands
/// that the light has among these.
ShLight limit_bands(const ShLight& light, int bands, math::SphericalWindow window = math::SphericalWindow::None);

/// Raw radiance SH coefficients of a probe, in double, weighted by solid angles that are normalised to sum to 4π;
/// 1 ≤ bands ≤ 32. Does not depend on the number of threads.
ShLight project(const ProbeImage& probe, int bands);

}  // namespace rowland::lighting
