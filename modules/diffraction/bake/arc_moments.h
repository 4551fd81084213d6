#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/lighting/sh_light.h"

namespace rowland::diffraction {

/// Number of arc moments of n-band light: 2n − 1.
constexpr int arc_moment_count(int bands) {
    return 2 * bands - 1;
}

/// The basis of the arc profiles of n-band light (PHYSICS §5), A(a) = r Q₁(a) + r² Q₂(a),
/// r = √(1−a²): B_k = r U_k(a) = sin((k+1)ϑ) with a = cos ϑ for k < n, B_k = r² U_{k−n}(a) for the n−1 others; U_k the
/// Chebyshev polynomials of the second kind. 0 for |a| ≥ 1.
void evaluate_arc_basis(double a, int bands, std::span<double> values);

/// The exact linear map from n² SH coefficients in the tangent frame to the 2n−1 arc moments q: A(a) = Σ_k q_k B_k(a),
/// flat lobe.
class ArcMoments {
 public:
    /// 1 ≤ bands ≤ 32.
    explicit ArcMoments(int bands);

    /// q per RGB channel. Light of fewer bands counts as 0 in the others; more are ignored.
    std::vector<glm::dvec3> operator()(const lighting::ShLight& tangent_light) const;

    /// Row k, column i; (2n−1)·n² entries, row by row.
    const std::vector<double>& matrix() const { return matrix_; }
    int bands() const { return bands_; }
    /// Largest distance of Σ_k matrix_ki B_k(a) from C_i(a), at samples between those of the fit.
    double residual() const { return residual_; }

 private:
    int bands_;
    std::vector<double> matrix_;
    double residual_ = 0.0;
};

}  // namespace rowland::diffraction
