#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace rowland::lighting {

/// Light from all directions as raw radiance SH coefficients: linear Rec.709/D65 RGB, world axes, no window, no cosine,
/// no 1/π. Everything else (irradiance, windowed or rotated light) is derived from this.
struct ShLight {
    int bands = 0;
    std::vector<glm::dvec3> coefficients;  ///< bands², index l(l+1)+m
};

}  // namespace rowland::lighting
