#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/math/quadrature.h"
#include "engine/math/sh_basis.h"
#include "engine/math/sh_rotation.h"
#include "modules/diffraction/model/cover.h"
#include "modules/diffraction/model/lobe.h"

namespace rowland::diffraction {

/// The SH coefficients of the light that one arc gathers (PHYSICS §5):
/// C_i(a) = ½ ∫₀^π Y_i(a, r cos t, r sin t) · 2 D_h(r cos t + v_h) · r sin t dt, r = √(1−a²), in the frame (g, h, n).
/// For light Σ l_i Y_i the arc profile is A(a) = Σ C_i(a) l_i. For the flat lobe 2 D_h = 1, whatever v_h. A cover
/// multiplies the integrand by T(r sin t), PHYSICS (27).
///
/// The computation is in the arc frame (h, n, g), whose polar axis is the axis of the arcs. There Y_lm is a function of
/// a times cos mt or sin |m|t, so that an arc takes 2n−1 moments and one evaluation of the basis. Sum over arcs in the
/// arc frame, then rotate once by to_tangent_frame().
class ArcCoefficients {
 public:
    /// 1 ≤ bands ≤ 32. Flat lobe: 1e-14 exact, under a cover 1e-9. Others: 1e-9.
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
    Moments interpolated(double r) const;
    void add_moments(const math::QuadratureRule& rule, const Stretch& stretch, const Circle& arc,
                     const LobeDensity& density, Moments& result) const;

    int bands_;
    GrooveLobe lobe_;
    std::optional<Cover> cover_;
    math::QuadratureRule core_rule_;  ///< on [0, 1], stretched over the part of the arc that the lobe's core reaches
    math::QuadratureRule tail_rule_;  ///< on [0, 1], for the rest of the arc, where the lobe has tails
    math::ShRotation to_tangent_frame_;
    std::vector<Moments> of_radius_;  ///< flat lobe: at Chebyshev nodes of r
};

}  // namespace rowland::diffraction
