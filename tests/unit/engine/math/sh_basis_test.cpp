#include "engine/math/sh_basis.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "engine/math/quadrature.h"
#include "tests/support/csv.h"
#include "tests/support/test_data.h"
#include "tests/unit/engine/math/directions.h"

namespace rowland::math {
namespace {

using std::numbers::pi;

std::vector<double> basis(const glm::dvec3& direction, int bands) {
    std::vector<double> values(static_cast<std::size_t>(sh_count(bands)));
    evaluate_sh(direction, bands, values);
    return values;
}

TEST(ShBasis, AgreesWithPublishedValues) {
    ROWLAND_TEST_DATA(path, "data/facts/sh_real_values_l0_8.csv");
    const test::Csv table = test::read_csv(path);
    ASSERT_GT(table.rows.size(), 81u);
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        // The table rounds its directions to 15 digits.
        const glm::dvec3 direction(table.number(row, "x"), table.number(row, "y"), table.number(row, "z"));
        const auto values = basis(glm::normalize(direction), 9);
        const int index = table.integer(row, "index");
        ASSERT_EQ(index, sh_index(table.integer(row, "l"), table.integer(row, "m")));
        EXPECT_NEAR(values[static_cast<std::size_t>(index)], table.number(row, "Y_no_condon_shortley"), 1e-12)
            << "row " << row;
    }
}

TEST(ShBasis, FirstBandsAreTheContractsPolynomials) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
    const auto values = basis(d, 3);
    // PHYSICS §1 prints six digits.
    EXPECT_NEAR(values[0], 0.282095, 5e-7);
    EXPECT_NEAR(values[1], 0.488603 * d.y, 5e-7);
    EXPECT_NEAR(values[2], 0.488603 * d.z, 5e-7);
    EXPECT_NEAR(values[3], 0.488603 * d.x, 5e-7);
    EXPECT_NEAR(values[4], 1.092548 * d.x * d.y, 5e-7);
}

TEST(ShBasis, AdditionTheoremHoldsTo32Bands) {
    for (const glm::dvec3& direction : test::scattered_directions(200)) {
        const auto values = basis(direction, kMaximumBands);
        for (int l = 0; l < kMaximumBands; ++l) {
            double sum = 0;
            for (int m = -l; m <= l; ++m) {
                const double y = values[static_cast<std::size_t>(sh_index(l, m))];
                sum += y * y;
            }
            EXPECT_NEAR(sum / ((2 * l + 1) / (4 * pi)), 1, 1e-12) << "band " << l;
        }
    }
}

TEST(ShBasis, IsOrthonormalOverTheSphere) {
    constexpr int kBands = 12;
    // Products are polynomials of degree ≤ 22: 12 Gauss nodes in z and 24 equal steps in φ integrate them exactly.
    const QuadratureRule rule = gauss_legendre(kBands, -1, 1);
    constexpr int kSteps = 24;
    constexpr std::size_t kCount = std::size_t{kBands} * kBands;
    std::vector<double> gram(kCount * kCount, 0.0);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
        for (int step = 0; step < kSteps; ++step) {
            const double phi = 2 * pi * step / kSteps;
            const double z = rule.nodes[i];
            const double r = std::sqrt(1 - z * z);
            const auto values = basis({r * std::cos(phi), r * std::sin(phi), z}, kBands);
            for (std::size_t a = 0; a < kCount; ++a)
                for (std::size_t b = 0; b < kCount; ++b)
                    gram[a * kCount + b] += rule.weights[i] * 2 * pi / kSteps * values[a] * values[b];
        }
    for (std::size_t a = 0; a < kCount; ++a)
        for (std::size_t b = 0; b < kCount; ++b)
            EXPECT_NEAR(gram[a * kCount + b], a == b ? 1.0 : 0.0, 1e-12) << a << ", " << b;
}

TEST(ShBasis, FewerBandsAreThePrefixOfMore) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(-0.2, 0.7, 0.1));
    const auto many = basis(d, kMaximumBands);
    for (int bands = 1; bands < kMaximumBands; ++bands) {
        const auto few = basis(d, bands);
        for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i], many[i]);
    }
}

}  // namespace
}  // namespace rowland::math
