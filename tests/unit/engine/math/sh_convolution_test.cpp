#include "engine/math/sh_convolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/math/quadrature.h"
#include "tests/support/csv.h"
#include "tests/support/test_data.h"

namespace rowland::math {
namespace {

TEST(ShConvolution, ClampedCosineAgreesWithPublishedFactors) {
    ROWLAND_TEST_DATA(path, "data/facts/sh_clamped_cosine_A_l.csv");
    const test::Csv table = test::read_csv(path);
    ASSERT_FALSE(table.rows.empty());
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        EXPECT_NEAR(clamped_cosine_factor(table.integer(row, "l")), table.number(row, "A_l"), 1e-14);  // as printed
}

TEST(ShConvolution, ClampedCosineIsItsDefiningIntegral) {
    // A_l = 2π ∫₀¹ P_l(z) z dz [Ramamoorthi & Hanrahan 2001]; degree ≤ 41, exact with 32 nodes.
    const QuadratureRule rule = gauss_legendre(32, 0, 1);
    for (int l = 0; l <= 40; ++l) {
        double sum = 0;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i)
            sum += rule.weights[i] * rule.nodes[i] * std::legendre(static_cast<unsigned>(l), rule.nodes[i]);
        EXPECT_NEAR(clamped_cosine_factor(l), 2 * std::numbers::pi * sum, 1e-13) << "band " << l;
    }
}

}  // namespace
}  // namespace rowland::math
