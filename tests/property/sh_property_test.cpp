// Spherical harmonics, their rotation, windows and quadrature.
#include <glm/matrix.hpp>

#include "engine/math/quadrature.h"
#include "engine/math/sh_convolution.h"
#include "engine/math/sh_rotation.h"
#include "engine/math/sh_window.h"
#include "tests/property/generators.h"

namespace rowland::property {
namespace {

using namespace math;

/// PHYSICS §8: Σ_m Y_lm² = (2l+1)/4π in every direction; 1e-12 relative.
RC_GTEST_PROP(ShProperty, SquaresOfABandAddUp, ()) {
    const int bands = *whole(1, kMaximumBands);
    std::vector<double> y(static_cast<std::size_t>(sh_count(bands)));
    evaluate_sh(*direction(), bands, y);
    for (int l = 0; l < bands; ++l) {
        double sum = 0.0;
        for (int m = -l; m <= l; ++m) {
            const double value = y[static_cast<std::size_t>(sh_index(l, m))];
            sum += value * value;
        }
        const double expected = (2 * l + 1) / (4.0 * std::numbers::pi);
        RC_ASSERT(std::abs(sum - expected) <= 1e-12 * expected);
    }
}

/// PHYSICS §8: R Rᵀ = 1 to 1e-12 for 16 bands.
RC_GTEST_PROP(ShRotationProperty, IsOrthogonal, ()) {
    const ShRotation r(*rotation(), 16);
    for (int l = 0; l < 16; ++l)
        for (int i = -l; i <= l; ++i)
            for (int j = i; j <= l; ++j) {
                double product = 0.0;
                for (int k = -l; k <= l; ++k) product += r.entry(l, i, k) * r.entry(l, j, k);
                RC_ASSERT(std::abs(product - (i == j ? 1.0 : 0.0)) <= 1e-12);
            }
}

/// PHYSICS §8: R(ab) = R(a) R(b) to 1e-12.
RC_GTEST_PROP(ShRotationProperty, Composes, ()) {
    const glm::dmat3 a = *rotation();
    const glm::dmat3 b = *rotation();
    const ShRotation ra(a, 16);
    const ShRotation rb(b, 16);
    const ShRotation rab(a * b, 16);
    for (int l = 0; l < 16; ++l)
        for (int i = -l; i <= l; ++i)
            for (int j = -l; j <= l; ++j) {
                double product = 0.0;
                for (int k = -l; k <= l; ++k) product += ra.entry(l, i, k) * rb.entry(l, k, j);
                RC_ASSERT(std::abs(product - rab.entry(l, i, j)) <= 1e-12);
            }
}

/// f'(M s) = f(s). Errors of 1e-13 a basis function (32 bands) over as many terms as there are: 1e-11 of Σ|c|.
RC_GTEST_PROP(ShRotationProperty, TurnsTheFunction, ()) {
    const lighting::ShLight light = *sh_light(kMaximumBands);
    const glm::dmat3 m = *rotation();
    const glm::dvec3 s = *direction();
    std::vector<glm::dvec3> turned(light.coefficients.size());
    ShRotation(m, light.bands).apply(std::span<const glm::dvec3>(light.coefficients), turned);
    std::vector<double> here(turned.size());
    std::vector<double> there(turned.size());
    evaluate_sh(s, light.bands, here);
    evaluate_sh(m * s, light.bands, there);
    glm::dvec3 difference(0.0);
    for (std::size_t i = 0; i < turned.size(); ++i)
        difference += there[i] * turned[i] - here[i] * light.coefficients[i];
    RC_ASSERT(largest(difference) <= 1e-11 * total(light));
}

/// A turn by ε moves what it turns by no more than l ε in band l: near the identity nothing jumps. 1e-12: rounding.
RC_GTEST_PROP(ShRotationProperty, IsContinuousAtTheIdentity, ()) {
    const double angle = *log_uniform(1e-16, 1e-4);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const ShRotation r(glm::dmat3(c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0), 16);
    for (int l = 0; l < 16; ++l)
        for (int i = -l; i <= l; ++i)
            for (int j = -l; j <= l; ++j)
                RC_ASSERT(std::abs(r.entry(l, i, j) - (i == j ? 1.0 : 0.0)) <= l * angle + 1e-12);
}

RC_GTEST_PROP(ShWindowProperty, FallsFromOneAndStaysPositive, ()) {
    const auto window = *rc::gen::element(SphericalWindow::None, SphericalWindow::Lanczos, SphericalWindow::Hann);
    const int bands = *whole(1, kMaximumBands);
    double before = 1.0;
    RC_ASSERT(window_factor(window, 0, bands) == 1.0);
    for (int l = 0; l < bands; ++l) {
        const double factor = window_factor(window, l, bands);
        RC_ASSERT(factor > 0.0);
        RC_ASSERT(factor <= before);
        before = factor;
    }
    RC_ASSERT(std::isfinite(clamped_cosine_factor(bands)));
}

/// Weights are positive and add up to the length; powers up to x³ (where there are two nodes) integrate exactly. 1e-13:
/// rounding of up to 400 terms.
RC_GTEST_PROP(QuadratureProperty, IntegratesCubicsOnAnyInterval, ()) {
    const int count = *whole(2, 400);
    const double a = *uniform(-10.0, 10.0);
    const double b = a + *log_uniform(1e-6, 10.0);
    const QuadratureRule rule = gauss_legendre(count, a, b);
    double before = a;
    double length = 0.0;
    double cubic = 0.0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        RC_ASSERT(rule.weights[i] > 0.0);
        RC_ASSERT(rule.nodes[i] > before);
        before = rule.nodes[i];
        length += rule.weights[i];
        const double t = (rule.nodes[i] - a) / (b - a);
        cubic += rule.weights[i] * t * t * t;
    }
    RC_ASSERT(std::abs(length - (b - a)) <= 1e-13 * (b - a));
    // t itself carries a's rounding.
    RC_ASSERT(std::abs(cubic / (b - a) - 0.25) <= 1e-13 + 4e-16 * std::abs(a) / (b - a));
}

}  // namespace
}  // namespace rowland::property
