#include "modules/diffraction/bake/arc_coefficients.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/math/sh_basis.h"

namespace rowland::diffraction {

namespace {

constexpr double kPi = std::numbers::pi;

/// The flat lobe's integrand is a trigonometric polynomial of degree `bands` in t over half a period: 16 nodes give
/// 1e-15 at 5 bands. A Gaussian lobe adds a bump that takes up to 1/17 of the interval: 40 nodes more.
int node_count(int bands, const GrooveLobe& lobe) {
    const int smooth = std::max(16, 2 * bands + 6);
    return is_flat(lobe) ? smooth : smooth + 40;
}

/// The cyclic exchange of axes (h, n, g) → (g, h, n). Columns are the images of the first frame's axes.
glm::dmat3 arc_to_tangent_axes() {
    return {0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0};
}

}  // namespace

/// ∫ cos(mt) w dt and ∫ sin(mt) w dt over the arc, w = D_h(r cos t + v_h) r sin t.
struct ArcCoefficients::Moments {
    std::array<double, math::kMaximumBands> cosine{};
    std::array<double, math::kMaximumBands> sine{};
};

ArcCoefficients::ArcCoefficients(int bands, const GrooveLobe& lobe)
    : bands_(bands),
      lobe_(lobe),
      rule_(math::gauss_legendre(node_count(bands, lobe), 0.0, 1.0)),
      to_tangent_frame_(arc_to_tangent_axes(), bands) {}

ArcCoefficients::Moments ArcCoefficients::moments(double r, double v_h, double wavelength_nm) const {
    const double half_width = lobe_half_width(lobe_);
    const double begin = is_flat(lobe_) ? 0.0 : std::acos(std::clamp((half_width - v_h) / r, -1.0, 1.0));
    const double end = is_flat(lobe_) ? kPi : std::acos(std::clamp((-half_width - v_h) / r, -1.0, 1.0));
    const LobeDensity density(lobe_, wavelength_nm);
    Moments result;
    for (std::size_t node = 0; node < rule_.nodes.size(); ++node) {
        const double t = begin + (end - begin) * rule_.nodes[node];
        const double c = std::cos(t);
        const double s = std::sin(t);
        const double weight = (end - begin) * rule_.weights[node] * r * s * density(r * c + v_h);
        // cos and sin of mt by turning on by t.
        double cosine = weight;
        double sine = 0.0;
        for (std::size_t m = 0; m < static_cast<std::size_t>(bands_); ++m) {
            result.cosine[m] += cosine;
            result.sine[m] += sine;
            const double next = cosine * c - sine * s;
            sine = sine * c + cosine * s;
            cosine = next;
        }
    }
    return result;
}

void ArcCoefficients::accumulate(double a, double v_h, double wavelength_nm, double weight,
                                 std::span<double> sum) const {
    if (std::abs(a) >= 1.0 || weight == 0.0) return;
    const double r = std::sqrt((1.0 - a) * (1.0 + a));
    const Moments arc = moments(r, v_h, wavelength_nm);
    // At t = 0 every Y_lm with m ≥ 0 is its function of a.
    std::array<double, math::sh_count(math::kMaximumBands)> polar;
    math::evaluate_sh({r, 0.0, a}, bands_, polar);
    for (int l = 0; l < bands_; ++l) {
        for (int m = 0; m <= l; ++m) {
            const double amplitude = weight * polar[static_cast<std::size_t>(math::sh_index(l, m))];
            const auto k = static_cast<std::size_t>(m);
            sum[static_cast<std::size_t>(math::sh_index(l, m))] += amplitude * arc.cosine[k];
            if (m > 0) sum[static_cast<std::size_t>(math::sh_index(l, -m))] += amplitude * arc.sine[k];
        }
    }
}

void ArcCoefficients::to_tangent_frame(std::span<const double> arc_frame, std::span<double> tangent_frame) const {
    to_tangent_frame_.apply(arc_frame, tangent_frame);
}

}  // namespace rowland::diffraction
