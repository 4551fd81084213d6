#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/lighting/sh_light.h"
#include "engine/math/quadrature.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/model/lobe.h"

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

    /// q per RGB channel. Bands that the light lacks count as 0; bands beyond bands() are ignored.
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

/// The SH coefficients of the light that one arc gathers (PHYSICS §5):
/// C_i(a) = ½ ∫₀^π Y_i(a, r cos t, r sin t) · 2 D_h(r cos t + v_h) · r sin t dt, r = √(1−a²), in the frame (g, h, n).
/// For light Σ l_i Y_i the arc profile is A(a) = Σ C_i(a) l_i. For the flat lobe 2 D_h = 1, whatever v_h. A cover
/// multiplies the integrand by T(r sin t), PHYSICS (10.2).
///
/// The computation is in the arc frame (h, n, g), whose polar axis is the axis of the arcs. There Y_lm is a function of
/// a times cos mt or sin |m|t, so that an arc takes 2n−1 moments and one evaluation of the basis. Callers sum over arcs
/// in the arc frame and rotate the sum once by to_tangent_frame().
class ArcCoefficients {
 public:
    /// 1 ≤ bands ≤ 32. Accurate to 1e-14 for the flat lobe without a cover, else to 1e-9.
    ArcCoefficients(int bands, const GrooveLobe& lobe, const std::optional<Cover>& cover = std::nullopt);

    /// Adds weight · C_i(a), in the arc frame, to `sum` (bands² entries); nothing for |a| ≥ 1.
    void accumulate(double a, double v_h, double wavelength_nm, double weight, std::span<double> sum) const;

    /// Coefficients in (h, n, g) → coefficients in (g, h, n), bands² entries each.
    void to_tangent_frame(std::span<const double> arc_frame, std::span<double> tangent_frame) const;

    int bands() const { return bands_; }

 private:
    /// ∫ cos(mt) w dt and ∫ sin(mt) w dt over the arc, w = D_h(r cos t + v_h) r sin t T(r sin t).
    struct Moments {
        std::array<double, math::kMaximumBands> cosine{};
        std::array<double, math::kMaximumBands> sine{};
    };
    struct Stretch;
    struct Circle;
    Moments moments(double r, double v_h, double wavelength_nm) const;
    Moments integrated(double r, double v_h, double wavelength_nm) const;
    Moments summed_orders(const PitSequenceLobe& lobe, double r, double v_h, double wavelength_nm) const;
    Moments interpolated(double r) const;
    void add_moments(const math::QuadratureRule& rule, const Stretch& stretch, const Circle& arc,
                     const LobeDensity& density, Moments& result) const;

    int bands_;
    GrooveLobe lobe_;
    std::optional<Cover> cover_;
    /// On [0, 1], stretched over the part of the arc that the lobe's core, or one order of a pit sequence, reaches.
    math::QuadratureRule core_rule_;
    math::QuadratureRule tail_rule_;  ///< on [0, 1], for the rest of the arc, where the lobe has tails
    math::ShRotation to_tangent_frame_;
    std::vector<Moments> of_radius_;  ///< flat lobe: at Chebyshev nodes of r
};

}  // namespace rowland::diffraction
