#include "engine/lighting/direction_weight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "engine/math/quadrature.h"
#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {
namespace {

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

}  // namespace
}  // namespace rowland::lighting
