#include "modules/diffraction/model/fejer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/csv.h"
#include "tests/support/test_data.h"

namespace rowland::diffraction {
namespace {

/// PHYSICS §9: 1e-12 relative where the ratio is above 1e-20, else 1e-20 absolute, against 60-digit arithmetic.
TEST(Fejer, MatchesHighPrecisionInDouble) {
    ROWLAND_TEST_DATA(path, "oracle/fejer_ratio.csv");
    const test::Csv oracle = test::read_csv(path);
    ASSERT_GT(oracle.rows.size(), 100U);
    for (std::size_t row = 0; row < oracle.rows.size(); ++row) {
        const double expected = oracle.number(row, "ratio");
        const double found = fejer(oracle.number(row, "N"), oracle.number(row, "delta"));
        const double tolerance = expected > 1e-20 ? 1e-12 * expected : 1e-20;
        EXPECT_NEAR(found, expected, tolerance)
            << "N " << oracle.text(row, "N") << " delta " << oracle.text(row, "delta");
    }
}

/// PHYSICS §9: 1e-5 absolute in float.
TEST(Fejer, MatchesHighPrecisionInFloat) {
    ROWLAND_TEST_DATA(path, "oracle/fejer_ratio.csv");
    const test::Csv oracle = test::read_csv(path);
    for (std::size_t row = 0; row < oracle.rows.size(); ++row) {
        const auto grooves = static_cast<float>(oracle.number(row, "N"));
        const auto delta = static_cast<float>(oracle.number(row, "delta"));
        EXPECT_NEAR(fejer(grooves, delta), oracle.number(row, "ratio"), 1e-5)
            << "N " << oracle.text(row, "N") << " delta " << oracle.text(row, "delta");
    }
}

/// ∫F_N = 1/N over a period. The midpoint rule with more than N nodes is exact for this trigonometric polynomial.
TEST(Fejer, MeanOverAPeriodIsOneOverN) {
    for (const int grooves : {1, 2, 7, 49, 1500}) {
        double sum = 0.0;
        const int nodes = 4 * grooves;
        for (int i = 0; i < nodes; ++i) sum += fejer(static_cast<double>(grooves), (i + 0.5) / nodes - 0.5);
        EXPECT_NEAR(sum / nodes, 1.0 / grooves, 1e-12) << grooves;
    }
}

TEST(Fejer, OneGrooveDoesNotInterfere) {
    for (const double delta : {0.0, 1e-9, 0.3, 0.5, 1.0}) EXPECT_EQ(fejer(1.0, delta), 1.0);
}

}  // namespace
}  // namespace rowland::diffraction
