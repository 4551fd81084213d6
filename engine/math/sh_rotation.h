#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rowland::math {

/// Rotates SH coefficients: for f(s) = Σ c_i Y_i(s) and a rotation matrix M, apply() gives the coefficients of f' with
/// f'(M s) = f(s). With M's *rows* (g, h, n), c' describes the same light in the tangent frame (g, h, n).
/// Built per band by the recurrence of Ivanic & Ruedenberg (1996, with the 1998 corrections); no angles are taken, so
/// identity and 180° turns are ordinary. Orthogonal to 1e-12 for bands ≤ 16.
class ShRotation {
 public:
    /// `rotation` must be a proper rotation (determinant +1). 1 ≤ bands ≤ 32.
    ShRotation(const glm::dmat3& rotation, int bands);

    int bands() const { return bands_; }
    /// Entry M_ij of band l, i, j in [-l, l]: ∫ Y_li(M s) Y_lj(s) ds.
    double entry(int l, int i, int j) const;

    /// out = rotated in; both of size ≥ bands², not overlapping.
    void apply(std::span<const double> in, std::span<double> out) const;
    void apply(std::span<const glm::dvec3> in, std::span<glm::dvec3> out) const;

 private:
    int bands_;
    std::vector<double> blocks_;  ///< band l: (2l+1)² entries, row-major, bands one after another
};

}  // namespace rowland::math
