#include "engine/math/quadrature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rowland::math {
namespace {

TEST(Quadrature, IntegratesPolynomialsOfDegree2nMinus1Exactly) {
    for (const int count : {1, 2, 3, 4, 5, 8, 16, 33, 64}) {
        const QuadratureRule rule = gauss_legendre(count, -0.5, 2);
        ASSERT_EQ(rule.nodes.size(), static_cast<std::size_t>(count));
        for (int degree = 0; degree < 2 * count; ++degree) {
            double sum = 0;
            double scale = 0;
            for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
                sum += rule.weights[i] * std::pow(rule.nodes[i] / 2, degree);
                scale += rule.weights[i] * std::pow(std::abs(rule.nodes[i] / 2), degree);
            }
            const double exact = 2 * (1 - std::pow(-0.25, degree + 1)) / (degree + 1);
            // Rounding: `count` terms, each wrong by a few units of 2e-16, `degree` of them from the power.
            EXPECT_NEAR(sum, exact, 1e-15 * (degree + 4) * scale) << count << " nodes, degree " << degree;
        }
    }
}

TEST(Quadrature, NodesAscendInsideTheInterval) {
    const QuadratureRule rule = gauss_legendre(31, 3, 4);
    EXPECT_TRUE(std::is_sorted(rule.nodes.begin(), rule.nodes.end()));
    EXPECT_GT(rule.nodes.front(), 3);
    EXPECT_LT(rule.nodes.back(), 4);
    EXPECT_NEAR(rule.nodes[15], 3.5, 1e-15);
}

TEST(Quadrature, MatchesPublishedFivePointRule) {
    // Abramowitz & Stegun 1964, table 25.4.
    const QuadratureRule rule = gauss_legendre(5, -1, 1);
    EXPECT_NEAR(rule.nodes[4], 0.906179845938663993, 1e-15);
    EXPECT_NEAR(rule.nodes[3], 0.538469310105683091, 1e-15);
    EXPECT_NEAR(rule.weights[4], 0.236926885056189088, 1e-15);
    EXPECT_NEAR(rule.weights[2], 0.568888888888888889, 1e-15);
}

}  // namespace
}  // namespace rowland::math
