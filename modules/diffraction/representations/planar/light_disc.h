#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "engine/lighting/light_samples.h"
#include "modules/diffraction/model/cover.h"

namespace rowland::diffraction {

/// A plane's axes in the world: (e1, e2, n) right-handed. e1 comes from +X by the smallest rotation that takes the
/// nearer of +Y and −Y to n.
struct PlaneAxes {
    glm::dvec3 e1{1.0, 0.0, 0.0};
    glm::dvec3 e2{0.0, 1.0, 0.0};
    glm::dvec3 n{0.0, 0.0, 1.0};
};
PlaneAxes plane_axes(const glm::dvec3& normal);

/// The light of the upper hemisphere seen along n (orthographic): flux · s_n T(s_n) / 2 over (s·e1, s·e2) ∈ [−1, 1]² in
/// equal cells. Each sample is divided among the four cells around it, so that their centre of weight is its position.
struct LightDisc {
    int cells = 0;              ///< of a side; cell i is centred on (2i + 1)/cells − 1
    std::vector<float> fluxes;  ///< four floats (r, g, b, 0) per cell, row by row; rows along e2
};
/// Adds light to a cell, or to another four floats.
inline void add_scaled(float* to, const float* light, float weight) {
    for (int c = 0; c < 4; ++c) to[c] += weight * light[c];
}
/// The columns [begin, end) of a row outside which it is black. A cell holds light from up to a cell away.
std::pair<int, int> lit_columns(int cells, int row);

/// Uses all cores; the result does not depend on their number.
LightDisc light_on_disc(const lighting::LightSamples& texels, const PlaneAxes& axes, const std::optional<Cover>& cover,
                        int cells);

}  // namespace rowland::diffraction
