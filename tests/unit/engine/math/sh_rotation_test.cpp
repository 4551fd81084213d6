#include "engine/math/sh_rotation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/math/sh_basis.h"
#include "tests/support/csv.h"
#include "tests/support/test_data.h"
#include "tests/unit/engine/math/directions.h"

namespace rowland::math {
namespace {

/// Largest |Σ_k M_ik M_jk − δ_ij| over all bands.
double orthogonality_error(const ShRotation& rotation) {
    double worst = 0;
    for (int l = 0; l < rotation.bands(); ++l)
        for (int i = -l; i <= l; ++i)
            for (int j = -l; j <= l; ++j) {
                double dot = 0;
                for (int k = -l; k <= l; ++k) dot += rotation.entry(l, i, k) * rotation.entry(l, j, k);
                worst = std::max(worst, std::abs(dot - (i == j ? 1 : 0)));
            }
    return worst;
}

/// Largest |R(ab) − R(a) R(b)|.
double composition_error(const glm::dmat3& a, const glm::dmat3& b, int bands) {
    const ShRotation ra(a, bands);
    const ShRotation rb(b, bands);
    const ShRotation rab(a * b, bands);
    double worst = 0;
    for (int l = 0; l < bands; ++l)
        for (int i = -l; i <= l; ++i)
            for (int j = -l; j <= l; ++j) {
                double product = 0;
                for (int k = -l; k <= l; ++k) product += ra.entry(l, i, k) * rb.entry(l, k, j);
                worst = std::max(worst, std::abs(product - rab.entry(l, i, j)));
            }
    return worst;
}

TEST(ShRotation, AgreesWithPublishedMatrices) {
    ROWLAND_TEST_DATA(path, "data/facts/sh_rotation_matrices_l1_4.csv");
    const test::Csv table = test::read_csv(path);
    ASSERT_GT(table.rows.size(), 100u);
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const glm::dvec3 axis(table.number(row, "axis_x"), table.number(row, "axis_y"), table.number(row, "axis_z"));
        const ShRotation rotation(test::turn(axis, table.number(row, "angle_rad")), 5);
        const double entry =
            rotation.entry(table.integer(row, "l"), table.integer(row, "row_m"), table.integer(row, "col_m"));
        EXPECT_NEAR(entry, table.number(row, "M_no_condon_shortley"), 1e-12)
            << table.text(row, "rotation") << ", row " << row;
    }
}

TEST(ShRotation, IsOrthogonalTo16Bands) {
    for (const glm::dmat3& m : test::hard_rotations()) EXPECT_LT(orthogonality_error(ShRotation(m, 16)), 1e-12);
}

TEST(ShRotation, StaysOrthogonalAt32Bands) {
    // No contract beyond 16 bands; rounding grows about linearly with the band.
    for (const glm::dmat3& m : test::hard_rotations()) EXPECT_LT(orthogonality_error(ShRotation(m, 32)), 1e-11);
}

TEST(ShRotation, ComposesTo16Bands) {
    const auto rotations = test::hard_rotations();
    for (std::size_t i = 0; i < rotations.size(); ++i)
        for (std::size_t j = 0; j < rotations.size(); j += 3)
            EXPECT_LT(composition_error(rotations[i], rotations[j], 16), 1e-12) << i << ", " << j;
}

TEST(ShRotation, EveryBandCountHoldsTheSameBlocks) {
    const glm::dmat3 m = test::hard_rotations().back();
    const ShRotation all(m, 16);
    for (int bands = 1; bands < 16; ++bands) {
        const ShRotation some(m, bands);
        for (int l = 0; l < bands; ++l)
            for (int i = -l; i <= l; ++i)
                for (int j = -l; j <= l; ++j) EXPECT_EQ(some.entry(l, i, j), all.entry(l, i, j));
    }
}

TEST(ShRotation, IdentityIsExact) {
    const ShRotation rotation(glm::dmat3(1.0), 32);
    for (int l = 0; l < 32; ++l)
        for (int i = -l; i <= l; ++i)
            for (int j = -l; j <= l; ++j) EXPECT_NEAR(rotation.entry(l, i, j), i == j ? 1 : 0, 1e-13);
}

TEST(ShRotation, RotatedLightIsTheLightSeenFromTheTurnedFrame) {
    constexpr int kBands = 16;
    constexpr auto kCount = static_cast<std::size_t>(sh_count(kBands));
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal;
    std::vector<double> light(kCount);
    for (double& c : light) c = normal(random);
    std::vector<double> rotated(kCount);
    std::vector<double> y(kCount);
    const auto value = [&y](const std::vector<double>& c, const glm::dvec3& direction) {
        evaluate_sh(direction, kBands, y);
        double sum = 0;
        for (std::size_t i = 0; i < c.size(); ++i) sum += c[i] * y[i];
        return sum;
    };
    for (const glm::dmat3& m : test::hard_rotations()) {
        ShRotation(m, kBands).apply(light, rotated);
        for (const glm::dvec3& s : test::scattered_directions(20))
            // 256 terms of size about 1, each to 1e-13.
            EXPECT_NEAR(value(rotated, glm::normalize(m * s)), value(light, s), 1e-11);
    }
}

TEST(ShRotation, ColourChannelsRotateAlike) {
    constexpr auto kCount = static_cast<std::size_t>(sh_count(5));
    const ShRotation rotation(test::turn({1, 2, 3}, 0.7), 5);
    std::vector<double> light(kCount);
    std::vector<glm::dvec3> colours(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
        light[i] = 1 / (1.0 + static_cast<double>(i));
        colours[i] = light[i] * glm::dvec3(1, -2, 0.5);
    }
    std::vector<double> rotated(kCount);
    std::vector<glm::dvec3> rotated_colours(kCount);
    rotation.apply(light, rotated);
    rotation.apply(colours, rotated_colours);
    for (std::size_t i = 0; i < kCount; ++i)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(rotated_colours[i][c], rotated[i] * glm::dvec3(1, -2, 0.5)[c], 1e-15);
}

TEST(ShRotationDeathTest, RefusesReflections) {
    glm::dmat3 mirror(1.0);
    mirror[0][0] = -1;
    EXPECT_DEATH(ShRotation(mirror, 3), "proper rotation");
}

}  // namespace
}  // namespace rowland::math
