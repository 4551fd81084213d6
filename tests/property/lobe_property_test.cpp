// Lobes and orders of width: what few grooves, narrow lobes and pits do to light.
#include <algorithm>

#include "engine/math/sh_basis.h"
#include "modules/diffraction/bake/arc_coefficients.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/model/grating_equation.h"
#include "modules/diffraction/reference/reference.h"
#include "tests/property/generators.h"

namespace rowland::property {
namespace {

using namespace diffraction;

/// Y = 1 from everywhere.
lighting::ShLight white_light() {
    return {1, {glm::dvec3(2.0 * std::sqrt(std::numbers::pi))}};
}

glm::dvec3 under_white_light(const Grating& shape, const glm::dvec3& view) {
    const ShadingPoint frame{.view = view, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}};
    return reference_radiance(shape, white_light(), colour::LightSpectra(), std::span(&frame, 1)).front();
}

std::vector<int> with_zero_order(std::vector<int> orders) {
    orders.insert(std::lower_bound(orders.begin(), orders.end(), 0), 0);
    return orders;
}

/// The slope of a Gaussian is at most its peak/(σ√e). 1e-13: rounding of the exponent.
RC_GTEST_PROP(GaussianLobeProperty, IsContinuousInDirection, ()) {
    const double sigma = *log_uniform(1e-4, 10.0);
    const LobeDensity density(GaussianLobe{sigma}, 550.0);
    const double sum_h = *rc::gen::oneOf(uniform(-2.0, 2.0), uniform(-3.0 * sigma, 3.0 * sigma));
    const double step = *log_uniform(1e-16, 1e-3);
    const double slope = density(0.0) / sigma / std::sqrt(std::numbers::e);
    RC_ASSERT(std::abs(density(sum_h + step) - density(sum_h)) <= slope * step + 1e-13 * density(0.0));
}

/// σ ∂D/∂σ is D (z² − 1) plus D times a factor of 0 to 1 from the norm: at most 2 D(0). Any bend where the lobe is
/// taken for flat, or the norm for 1, would show as a jump.
RC_GTEST_PROP(GaussianLobeProperty, IsContinuousInItsWidth, ()) {
    const double sigma = *rc::gen::oneOf(log_uniform(1e-4, 10.0), log_uniform(0.05, 1000.0));
    const double sum_h = *rc::gen::oneOf(uniform(-2.0, 2.0), uniform(-3.0 * sigma, 3.0 * sigma));
    const double step = *log_uniform(1e-15, 1e-3);
    const LobeDensity here(GaussianLobe{sigma}, 550.0);
    const LobeDensity there(GaussianLobe{sigma * (1.0 + step)}, 550.0);
    RC_ASSERT(std::abs(there(sum_h) - here(sum_h)) <= (2.0 * step * (1.0 + step) + 1e-13) * here(0.0));
}

/// The lobe's shift by ε changes ∫ D Y ds_h by at most ε times D's variation, 2 D(0), times |Y|. 1e-6: the quadrature's
/// own error, as in ArcProperty.
RC_GTEST_PROP(GaussianLobeProperty, ArcCoefficientsAreContinuousInTheView, ()) {
    const GaussianLobe shape{*log_uniform(1e-3, 3.0)};
    const ArcCoefficients arcs(*whole(1, 8), shape);
    const double a = *uniform(-1.0, 1.0);
    const double v_h = *uniform(-1.0, 1.0);
    const double step = *log_uniform(1e-14, 1e-4);
    const double variation = 2.0 * lobe_density(shape, 0.0, 550.0);
    const auto coefficients = [&](double along) {
        std::vector<double> arc_frame(static_cast<std::size_t>(math::sh_count(arcs.bands())), 0.0);
        std::vector<double> result(arc_frame.size());
        arcs.accumulate(a, along, 550.0, 1.0, arc_frame);
        arcs.to_tangent_frame(arc_frame, result);
        return result;
    };
    const std::vector<double> here = coefficients(v_h);
    const std::vector<double> there = coefficients(v_h + step);
    for (int l = 0; l < arcs.bands(); ++l) {
        const double norm = std::sqrt((2 * l + 1) / (4.0 * std::numbers::pi));
        for (int m = -l; m <= l; ++m) {
            const auto i = static_cast<std::size_t>(math::sh_index(l, m));
            RC_ASSERT(std::abs(there[i] - here[i]) <= norm * (variation * step + 1e-6));
        }
    }
}

/// Pits of any length under uniform light, from any side, with all orders: never more than fell in. 1e-6: quadrature.
RC_GTEST_PROP(PitsProperty, ReturnNoMoreLightThanFallsIn, ()) {
    Grating shape;
    shape.pitch_nm = *log_uniform(300.0, 2000.0);
    shape.profile = *profile(shape.pitch_nm);
    shape.lobe = PitsLobe{*log_uniform(100.0, 5000.0), *rc::gen::oneOf(uniform(0.0, 1.0), rc::gen::element(0.0, 1.0))};
    shape.orders = *rc::gen::element(with_zero_order(all_orders(shape.pitch_nm)), std::vector<int>{-1, 0, 1});
    RC_PRE(shape.orders.size() <= 7U);
    const glm::dvec3 xyz = under_white_light(shape, *upper_direction());
    RC_ASSERT(is_finite(xyz));
    RC_ASSERT(xyz.x >= 0.0 && xyz.y >= 0.0 && xyz.z >= 0.0);
    RC_ASSERT(xyz.y <= 1.0 + 1e-6);
}

/// A few grooves with every order: what N grooves send out is the power spectrum of a phase, whose integral is 1
/// (Parseval), of which the flat lobe and the horizon leave less. Work grows with grooves × pitch.
Grating few_grooves(double finest_nm, double coarsest_nm, int most_grooves) {
    Grating shape;
    shape.pitch_nm = *log_uniform(finest_nm, coarsest_nm);
    shape.grooves = *whole(1, most_grooves);
    const double depth_nm = *rc::gen::oneOf(uniform(0.0, 400.0), log_uniform(1e-3, 1e3));
    if (*whole(0, 1) == 0)
        shape.profile = LamellarProfile{*rc::gen::oneOf(uniform(0.0, 1.0), rc::gen::element(1e-9, 0.5)), depth_nm};
    else
        shape.profile = SinusoidalProfile{depth_nm};
    shape.orders = with_zero_order(all_orders(shape.pitch_nm));
    return shape;
}

/// 1e-3: steps of the reference's sum over the orders' width.
RC_GTEST_PROP(FewGroovesProperty, ReturnNoMoreLightThanFallsIn, ()) {
    if (*whole(0, 3) != 0) return;  // a case takes .4 s: every fourth will do
    const glm::dvec3 xyz = under_white_light(few_grooves(300.0, 500.0, 8), *upper_direction());
    RC_ASSERT(is_finite(xyz));
    RC_ASSERT(xyz.x >= 0.0 && xyz.y >= 0.0 && xyz.z >= 0.0);
    RC_ASSERT(xyz.y <= 1.0 + 1e-3);
}

/// f, not only its integral, is finite, non-negative and reciprocal; and so is what is baked of it.
RC_GTEST_PROP(FewGroovesProperty, BrdfIsFiniteNonNegativeAndReciprocal, ()) {
    const Grating shape = few_grooves(300.0, 2000.0, 49);
    const glm::dvec3 s = *upper_direction();
    const glm::dvec3 v = *rc::gen::oneOf(upper_direction(), rc::gen::just(glm::dvec3(-s.x, -s.y, s.z)));
    const double wavelength_nm = *wavelength();
    const double f = brdf_energy(shape, s, v, wavelength_nm);
    RC_ASSERT(std::isfinite(f));
    RC_ASSERT(f >= 0.0);
    RC_ASSERT(f == brdf_energy(shape, v, s, wavelength_nm));
}

RC_GTEST_PROP(FewGroovesProperty, KernelIsFiniteAndNonNegative, ()) {
    if (*whole(0, 3) != 0) return;  // a case takes .2 s: every fourth will do
    const Grating shape = few_grooves(150.0, 250.0, 4);
    const ColourKernel kernel(shape, colour::LightSpectra());
    for (int i = 0; i < 20; ++i) {
        const glm::dmat3 k = kernel(*uniform(-2.0 * shape.pitch_nm, 2.0 * shape.pitch_nm));
        RC_ASSERT(is_finite(k));
        for (int c = 0; c < 3; ++c)
            for (int o = 0; o < 3; ++o) RC_ASSERT(k[c][o] >= 0.0);
    }
}

}  // namespace
}  // namespace rowland::property
