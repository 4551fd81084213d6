#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace rowland::math {

/// Real, orthonormal spherical harmonics over the sphere, no Condon–Shortley phase, polar axis z
/// [Ramamoorthi & Hanrahan 2001]: Y_0 = 0.282095, Y_1,-1 = 0.488603 y, Y_1,0 = 0.488603 z, Y_1,1 = 0.488603 x, ...
/// "n bands" means l < n.
inline constexpr int kMaximumBands = 32;

/// Number of coefficients of `bands` bands: bands².
constexpr int sh_count(int bands) {
    return bands * bands;
}

/// Index of (l, m): l(l+1)+m.
constexpr int sh_index(int l, int m) {
    return l * (l + 1) + m;
}

/// Evaluates all `bands`² functions at the unit vector `direction` into `values` (size ≥ bands², 1 ≤ bands ≤ 32), by
/// stable recurrences in l and m. Error < 1e-13 at 32 bands.
void evaluate_sh(const glm::dvec3& direction, int bands, std::span<double> values);

}  // namespace rowland::math
