#include "engine/lighting/light_metric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/lighting/environment_map.h"
#include "engine/math/quadrature.h"
#include "engine/math/sh_basis.h"
#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {
namespace {

/// Coefficient of band l of a product: ∫ product(cos γ) P_l(cos γ) over the sphere.
double band_weight(const LobeProduct& product, unsigned l) {
    // Nodes are dense near γ = 0: c = 1 − 2 x³.
    const math::QuadratureRule rule = math::gauss_legendre(200, 0.0, 1.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double x = rule.nodes[i];
        const double cosine = 1.0 - 2.0 * x * x * x;
        sum += rule.weights[i] * 6.0 * x * x * product(cosine) * std::legendre(l, cosine);
    }
    return 2.0 * std::numbers::pi * sum;
}

/// The scales stand for 1/l to 10 % down to the smoothing.
TEST(LightMetric, BandsCountByOneOverL) {
    const LobeProduct product(1e-9, {.smoothing = 2500.0});
    const auto weight = [&](unsigned l) { return l * std::exp(l * l / 2500.0) * band_weight(product, l); };
    for (const unsigned l : {8U, 12U, 16U, 24U, 32U}) EXPECT_NEAR(weight(l) / weight(16), 1.0, 0.1) << l;
}

/// A dim room with two lamps and a bright ceiling.
ProbeImage lamps_in_a_room() {
    return test::made_probe(Mapping::Equirectangular, 64, [](const glm::dvec3& d) {
        return glm::dvec3(1.0 + d.x, d.y > 0.9 ? 100.0 : 0.5, std::exp(300.0 * (d.z - 1.0)) * 1e3);
    });
}

constexpr int kMetricFace = 64;

/// The tree against a sum over all texels, one LobeProduct each. Nodes are a quarter of a deviation: 1/384 of the
/// variance.
TEST(LightMetric, TheTreeSumsWhatAllTexelsSum) {
    const ProbeImage probe = lamps_in_a_room();
    const KeyLightFit settings;
    const std::vector<CubeCell> cells = gather_cells(probe, kMetricFace);
    const LightSamples texels = cell_samples(cells);
    const MeasuredProbe measured(cells, kMetricFace, settings);
    // Each texel as a point light, measured by itself.
    for (const double concentration : {40.0, 600.0, 1e5})
        for (const glm::dvec3& direction : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), test::spread_direction(3, 20)}) {
            const MeasuredLobe lobe = measured.measure({direction, concentration});
            const LobeProduct product(1.0 / concentration, settings);
            glm::dvec3 expected(0.0);
            for (std::size_t i = 0; i < texels.size(); ++i) {
                const MeasuredLobe texel = measured.measure({texels.direction(i), kNarrowestConcentration});
                expected += inner_product(lobe, texel, product) * texels.flux(i);
            }
            EXPECT_LT(glm::length(measured.with(lobe) - expected), 0.01 * glm::length(expected)) << concentration;
        }
}

/// The inner product of two lobes as KeyLightFit words it, by sums over cells of .05 rad: for each scale, smooth both
/// lobes, subtract their SH in the exact bands, weight both by the direction, and integrate their product.
TEST(LightMetric, LobesAreComparedByTheErrorThatTheExactBandsLeave) {
    constexpr int kBands = 5;
    constexpr int kCells = 32;
    const KeyLightFit settings{.smoothing = 200.0, .exact_bands = kBands};
    const MeasuredProbe measured(gather_cells(lamps_in_a_room(), kMetricFace), kMetricFace, settings);
    const LobeShape shapes[] = {{test::spread_direction(3, 20), 300.0},
                                {glm::normalize(test::spread_direction(3, 20) + glm::dvec3(0.0, 0.1, 0.05)), 100.0},
                                {test::spread_direction(12, 20), 60.0}};
    const auto error_at = [&](const LobeShape& shape, double variance, const glm::dvec3& s) {
        const double smoothed = 1.0 / (1.0 / shape.concentration + 0.5 * variance);
        double shown = 0.0;
        const std::vector<double> factors = lobe_band_factors(smoothed, kBands);
        for (unsigned l = 0; l < kBands; ++l)
            shown +=
                (2 * l + 1) / (4.0 * std::numbers::pi) * factors[l] * std::legendre(l, glm::dot(s, shape.direction));
        return measured.weight().root(s) * (lobe_density({shape.direction, glm::dvec3(1.0), smoothed}, s) - shown);
    };
    const auto brute_force = [&](const LobeShape& a, const LobeShape& b) {
        double sum = 0.0;
        for (int scale = 0; scale < 4; ++scale) {
            const double variance = 2.0 / settings.smoothing * std::pow(4.0, scale);
            for (int face = 0; face < 6; ++face)
                for (int row = 0; row < kCells; ++row)
                    for (int column = 0; column < kCells; ++column) {
                        const glm::dvec3 s = glm::normalize(
                            cube_direction(face, (2 * column + 1.0) / kCells - 1, (2 * row + 1.0) / kCells - 1));
                        sum += std::sqrt(variance) * cube_solid_angle(kCells, column, row) * error_at(a, variance, s) *
                               error_at(b, variance, s);
                    }
        }
        return sum;
    };
    const double scale = brute_force(shapes[0], shapes[0]);
    for (const LobeShape& a : shapes)
        for (const LobeShape& b : {shapes[0], shapes[2]}) {
            const LobeProduct product(1.0 / a.concentration + 1.0 / b.concentration, settings);
            // The weight changes by a tenth over the widest lobe.
            EXPECT_NEAR(inner_product(measured.measure(a), measured.measure(b), product), brute_force(a, b),
                        0.05 * scale);
        }
}

}  // namespace
}  // namespace rowland::lighting
