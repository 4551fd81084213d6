#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "engine/lighting/environment_map.h"
#include "engine/lighting/light_metric.h"
#include "engine/math/quadrature.h"
#include "engine/math/spherical_harmonics.h"
#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {

namespace {

constexpr int kSize = 16;

std::vector<glm::vec3> uneven_texels() {
    std::vector<glm::vec3> texels;
    for (int i = 0; i < 6 * kSize * kSize; ++i) texels.emplace_back(i % 7, i % 11 == 0 ? 1000 : 1, 0.5 * (i % 3));
    return texels;
}

TEST(CubeTree, EveryDepthHoldsTheWholeLight) {
    const CubeTree tree(uneven_texels(), kSize);
    ASSERT_EQ(tree.side(tree.leaf_depth()), kSize);
    std::vector<glm::dvec3> flux;
    for (int depth = 0; depth <= tree.leaf_depth(); ++depth) {
        glm::dvec3 sum(0.0);
        double solid_angle = 0;
        for (int face = 0; face < 6; ++face)
            for (int row = 0; row < tree.side(depth); ++row)
                for (int column = 0; column < tree.side(depth); ++column) {
                    sum += glm::dvec3(tree.node(depth, face, column, row).flux);
                    solid_angle += tree.node(depth, face, column, row).solid_angle;
                }
        EXPECT_NEAR(solid_angle / (4 * std::numbers::pi), 1, 1e-5);  // single precision, 1536 addends
        flux.push_back(sum);
    }
    for (const glm::dvec3& f : flux) EXPECT_LT(glm::length(f - flux[0]) / glm::length(flux[0]), 1e-5);
}

TEST(CubeTree, ALoneLampIsWhereItStands) {
    std::vector<glm::vec3> texels(std::size_t{6} * kSize * kSize, glm::vec3(0.0f));
    texels[(3 * kSize + 5) * kSize + 9] = glm::vec3(100.0f);  // face 3, column 9, row 5
    const CubeTree tree(texels, kSize);
    const auto expected = glm::normalize(cube_direction(3, (2 * 9 + 1.0) / kSize - 1, (2 * 5 + 1.0) / kSize - 1));
    for (int depth = 0; depth <= tree.leaf_depth(); ++depth) {
        const int shrink = kSize / tree.side(depth);
        const auto& node = tree.node(depth, 3, 9 / shrink, 5 / shrink);
        EXPECT_LT(glm::length(glm::dvec3(node.source) - expected), 1e-6) << depth;
    }
}

TEST(CubeTree, OfCellsKeepsTheDirectionWithinACell) {
    std::vector<CubeCell> cells(std::size_t{6} * kSize * kSize);
    const glm::dvec3 lamp = glm::normalize(cube_direction(3, (2 * 9 + 1.7) / kSize - 1, (2 * 5 + 0.4) / kSize - 1));
    cells[(3 * kSize + 5) * kSize + 9] = {.flux = {2.0, 1.0, 0.5}, .direction_sum = 3.5 * lamp};
    const CubeTree tree(cells, kSize);
    for (int depth = 0; depth <= tree.leaf_depth(); ++depth) {
        const int shrink = kSize / tree.side(depth);
        const auto& node = tree.node(depth, 3, 9 / shrink, 5 / shrink);
        EXPECT_LT(glm::length(glm::dvec3(node.source) - lamp), 1e-6) << depth;
        EXPECT_EQ(node.flux, glm::vec3(2.0F, 1.0F, 0.5F)) << depth;
    }
}

/// The mean over normals by quadrature on the sphere, for a bright light from below.
TEST(DirectionWeight, IsTheMeanOfTheErrorRelativeToTheSignal) {
    std::vector<DirectionWeight::Signal> signals;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 s = test::spread_direction(i, 100);
        signals.push_back({s, 1.0 + 100.0 * std::exp(4.0 * (glm::dot(s, glm::dvec3(0.6, -0.8, 0.0)) - 1.0))});
    }
    const auto clamped_square = [](const glm::dvec3& n, const glm::dvec3& s) {
        return std::pow(std::max(0.0, glm::dot(n, s)), 2.0);
    };
    const math::QuadratureRule heights = math::gauss_legendre(30, -1.0, 1.0);
    constexpr int kAngles = 60;
    const auto mean = [&](const auto& function) {
        double sum = 0.0;
        for (std::size_t i = 0; i < heights.nodes.size(); ++i)
            for (int j = 0; j < kAngles; ++j) {
                const double angle = 2.0 * std::numbers::pi * j / kAngles;
                const double radius = std::sqrt(1.0 - heights.nodes[i] * heights.nodes[i]);
                sum += heights.weights[i] / (2.0 * kAngles) *
                       function(glm::dvec3(radius * std::cos(angle), heights.nodes[i], radius * std::sin(angle)));
            }
        return sum;
    };
    const auto signal = [&](const glm::dvec3& n) {
        double sum = 0.0;
        for (const DirectionWeight::Signal& one : signals) sum += clamped_square(n, one.direction) * one.square;
        return sum;
    };
    const double least = 4e-4 * mean(signal);
    const auto expected = [&](const glm::dvec3& s) {
        return std::sqrt(mean([&](const glm::dvec3& n) {
            return std::pow(0.5 + 0.5 * n.y, 2.0) * clamped_square(n, s) / (signal(n) + least);
        }));
    };
    const DirectionWeight weight(signals);
    const glm::dvec3 first = test::spread_direction(0, 12);
    for (int i = 1; i < 12; ++i) {
        const glm::dvec3 s = test::spread_direction(i, 12);
        const double ratio = expected(s) / expected(first);
        // Normals are .26 rad apart, directions .05.
        EXPECT_NEAR(weight.root(s) / weight.root(first), ratio, 0.02 * ratio) << i;
    }
}

/// One bright lamp from below: what the surfaces that face away from it see counts more than the lamp.
TEST(DirectionWeight, LightBehindMostHorizonsCountsLess) {
    const DirectionWeight::Signal signals[] = {{{0.0, -1.0, 0.0}, 1e4}, {{0.0, 1.0, 0.0}, 1.0}};
    const DirectionWeight weight(signals);
    EXPECT_GT(weight.root({0.0, 1.0, 0.0}), 3.0 * weight.root({0.0, -1.0, 0.0}));
}

TEST(DirectionWeight, IsOneInTheMeanAndContinuousAcrossFaces) {
    const DirectionWeight::Signal signals[] = {{glm::normalize(glm::dvec3(0.2, 0.9, 0.1)), 3.0}};
    const DirectionWeight weight(signals);
    double mean = 0.0;
    for (int i = 0; i < 200; ++i) mean += weight.root(test::spread_direction(i, 200)) / 200.0;
    EXPECT_NEAR(mean, 1.0, 0.1);
    const glm::dvec3 edge = glm::normalize(glm::dvec3(1.0, 1.0, 0.3));
    const glm::dvec3 step(1e-7, -1e-7, 0.0);
    EXPECT_NEAR(weight.root(edge + step), weight.root(edge - step), 1e-5);
    // Black probes: all directions count, none as infinity.
    EXPECT_TRUE(std::isfinite(DirectionWeight({}).root(edge)));
}

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
    const std::vector<CubeCell> cells = bin_into_cells(probe, kMetricFace);
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
    const MeasuredProbe measured(bin_into_cells(lamps_in_a_room(), kMetricFace), kMetricFace, settings);
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
