#include "engine/lighting/light_metric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/math/quadrature.h"
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

TEST(LightMetric, ExactBandsDoNotCount) {
    const LobeProduct product(1.0 / 300.0, {.exact_bands = 5});
    for (unsigned l = 0; l < 5; ++l) EXPECT_NEAR(band_weight(product, l), 0.0, 1e-10) << l;
    EXPECT_GT(band_weight(product, 5), 0.01);
}

/// The scales stand for 1/l to 10 % between the exact bands and the smoothing.
TEST(LightMetric, BandsCountByOneOverL) {
    const LobeProduct product(1e-9, {.smoothing = 2500.0, .exact_bands = 1});
    const auto weight = [&](unsigned l) { return l * std::exp(l * l / 2500.0) * band_weight(product, l); };
    for (const unsigned l : {8U, 12U, 16U, 24U, 32U}) EXPECT_NEAR(weight(l) / weight(16), 1.0, 0.1) << l;
}

/// The tree against a sum over all texels. Nodes are a third of a deviation: 1/216 of the variance.
TEST(LightMetric, TheTreeSumsWhatAllTexelsSum) {
    const ProbeImage probe = test::made_probe(Mapping::Equirectangular, 64, [](const glm::dvec3& d) {
        return glm::dvec3(1.0 + d.x, d.y > 0.9 ? 100.0 : 0.5, std::exp(300.0 * (d.z - 1.0)) * 1e3);
    });
    constexpr int kFace = 64;
    const KeyLightFit settings;
    const LightSamples texels = cell_samples(gather_cells(probe, kFace));
    const MeasuredProbe measured(CubeTree(gather_cells(probe, kFace), kFace), settings);
    for (const double concentration : {40.0, 600.0, 1e5})
        for (const glm::dvec3& direction : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), test::spread_direction(3, 20)}) {
            const LobeShape lobe{direction, concentration};
            const LobeProduct product(1.0 / concentration, settings);
            glm::dvec3 expected(0.0);
            for (std::size_t i = 0; i < texels.size(); ++i)
                expected += product(glm::dot(direction, texels.direction(i))) * texels.flux(i);
            EXPECT_LT(glm::length(measured.with(lobe) - expected), 0.01 * glm::length(expected)) << concentration;
        }
}

}  // namespace
}  // namespace rowland::lighting
