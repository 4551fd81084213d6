#include <algorithm>

#include "engine/math/quadrature.h"
#include "engine/math/spherical_harmonics.h"
#include "tests/support/csv.h"
#include "tests/support/files.h"
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

constexpr int kWindowBands = 5;

/// Windowed point light of five bands at the angle whose cosine is z: Σ w_l (2l+1)/4π P_l(z).
double point_light(SphericalWindow window, double z) {
    double sum = 0;
    for (int l = 0; l < kWindowBands; ++l)
        sum += window_factor(window, l, kWindowBands) * (2 * l + 1) / (4 * std::numbers::pi) *
               std::legendre(static_cast<unsigned>(l), z);
    return sum;
}

TEST(ShWindow, TradesPeakForUndershootAsMeasured) {
    // MEASUREMENTS §7 prints these with two and three digits.
    const double peak[] = {1.99, 1.05, 0.82};
    const double undershoot[] = {-0.152, -0.056, -0.038};
    int i = 0;
    for (const auto window : {SphericalWindow::None, SphericalWindow::Lanczos, SphericalWindow::Hann}) {
        const double top = point_light(window, 1);
        double lowest = top;
        for (int k = 0; k <= 20000; ++k) lowest = std::min(lowest, point_light(window, k / 10000.0 - 1));
        EXPECT_NEAR(top, peak[i], 0.005) << window_name(window);
        EXPECT_NEAR(lowest / top, undershoot[i], 0.0005) << window_name(window);
        ++i;
    }
}

TEST(ShWindow, ExponentialDampsByEigenvalueOfTheLaplacian) {
    EXPECT_EQ(exponential_window_factor(0.3, 0), 1);
    EXPECT_NEAR(exponential_window_factor(0.3, 2), std::exp(-1.8), 1e-15);
    EXPECT_EQ(exponential_window_factor(0, 7), 1);
}

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

TEST(ShRotation, AgreesWithPublishedMatrices) {
    ROWLAND_TEST_DATA(path, "data/facts/sh_rotation_matrices_l1_4.csv");
    const test::Csv table = test::read_csv(path);
    ASSERT_GT(table.rows.size(), 100u);
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const glm::dvec3 axis(table.number(row, "axis_x"), table.number(row, "axis_y"), table.number(row, "axis_z"));
        const ShRotation rotation(test::rotation_about(axis, table.number(row, "angle_rad")), 5);
        const double entry =
            rotation.entry(table.integer(row, "l"), table.integer(row, "row_m"), table.integer(row, "col_m"));
        EXPECT_NEAR(entry, table.number(row, "M_no_condon_shortley"), 1e-12)
            << table.text(row, "rotation") << ", row " << row;
    }
}

TEST(ShRotation, StaysOrthogonalAt32Bands) {
    // No contract beyond 16 bands; rounding grows about linearly with the band.
    for (const glm::dmat3& m : test::hard_rotations()) EXPECT_LT(orthogonality_error(ShRotation(m, 32)), 1e-11);
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

TEST(ShRotation, ColourChannelsRotateAlike) {
    constexpr auto kCount = static_cast<std::size_t>(sh_count(5));
    const ShRotation rotation(test::rotation_about({1, 2, 3}, 0.7), 5);
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
