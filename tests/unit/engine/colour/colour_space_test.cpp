#include "engine/colour/colour_space.h"
#include "engine/colour/illuminant.h"
#include "tests/support/expect.h"

namespace rowland::colour {

namespace {

using rowland::test::expect_near;

/// ACES AP1 with its white (about D60) [S-2014-004].
constexpr Primaries kAcesCg{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}};

TEST(Primaries, Rec709NeedsNoConversion) {
    EXPECT_FALSE(to_rec709(kRec709).has_value());
    Primaries rounded = kRec709;
    rounded.white = {0.3127, 0.3291};
    EXPECT_FALSE(to_rec709(rounded).has_value());
}

TEST(Primaries, AcesCgToRec709IsThePublishedMatrix) {
    // The ACES project's AP1 → Rec.709/D65 with Bradford adaptation, as printed to five digits.
    const double expected[3][3] = {
        {1.70505, -0.62179, -0.08326}, {-0.13026, 1.14080, -0.01055}, {-0.02400, -0.12897, 1.15297}};
    const auto matrix = to_rec709(kAcesCg);
    ASSERT_TRUE(matrix.has_value());
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            EXPECT_NEAR((*matrix)[column][row], expected[row][column], 2e-4) << row << ", " << column;
}

TEST(Primaries, WhiteOfD65IsWhite) {
    const glm::dvec3 white = xyz_to_rec709() * xy_to_xyz(kRec709.white);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1, 1e-12);
}

TEST(Primaries, WhiteStaysWhite) {
    const glm::dvec3 white = *to_rec709(kAcesCg) * glm::dvec3(1.0);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1, 1e-12);
}

TEST(Primaries, DegenerateOnesAreNotUsable) {
    EXPECT_TRUE(is_usable(kAcesCg));
    EXPECT_FALSE(is_usable({{0.3, 0.3}, {0.4, 0.4}, {0.5, 0.5}, {0.3, 0.3}}));
    Primaries dark = kRec709;
    dark.white.y = 0;
    EXPECT_FALSE(is_usable(dark));
}

TEST(WorkingSpace, WhiteStaysNeutral) {
    expect_near(xyz_to_acescg() * rec709_to_xyz() * glm::dvec3(1.0), glm::dvec3(1.0), 1e-12);
}

/// Spectral white: the basis sums to 1 within 1e-5 a wavelength, its luminance to 1e-6 (measured).
TEST(WorkingSpace, SpectralWhiteStaysNeutral) {
    const glm::dvec3 acescg = xyz_to_acescg() * rgb_to_xyz(LightSpectra(), glm::dvec3(1.0));
    expect_near(acescg, glm::dvec3(1.0), 1e-6);
}

/// Rec.709 → XYZ as printed in IEC 61966-2-1, and Rec.709 → ACEScg as in the ACES configs of OpenColorIO; four digits.
/// Our white has 5e-4 less Z than the printed one because spectra end at 380 nm.
TEST(WorkingSpace, MatricesAreThePublishedOnes) {
    const glm::dmat3 xyz = rec709_to_xyz();
    expect_near(xyz[0], {0.4124, 0.2126, 0.0193}, 2e-4);
    expect_near(xyz[1], {0.3576, 0.7152, 0.1192}, 2e-4);
    expect_near(xyz[2], {0.1805, 0.0722, 0.9505}, 6e-4);
    const glm::dmat3 acescg = xyz_to_acescg() * rec709_to_xyz();
    expect_near(acescg[0], {0.6131, 0.0702, 0.0206}, 2e-4);
    expect_near(acescg[1], {0.3395, 0.9164, 0.1096}, 2e-4);
    expect_near(acescg[2], {0.0474, 0.0135, 0.8698}, 2e-4);
}

glm::dvec3 oklab(const glm::dvec3& rgb) {
    return oklab_of_lms(rec709_to_oklab_lms() * rgb);
}

/// The values that CSS Color 4 prints for sRGB's primaries.
TEST(Oklab, PrimariesHaveThePublishedValues) {
    test::expect_near(oklab(glm::dvec3(1.0)), {1.0, 0.0, 0.0}, 1e-6);
    test::expect_near(oklab({1, 0, 0}), {0.62796, 0.22486, 0.12585}, 2e-5);
    test::expect_near(oklab({0, 1, 0}), {0.86644, -0.23389, 0.17950}, 2e-5);
    test::expect_near(oklab({0, 0, 1}), {0.45201, -0.03246, -0.31153}, 2e-5);
}

TEST(Oklab, InverseReturns) {
    const glm::dvec3 lms(0.4, 0.02, 1.7);
    test::expect_near(oklab_to_lms(oklab_of_lms(lms)), lms, 1e-12);
}

TEST(Oklab, HueDifferenceIsTheAngleAndIgnoresLightness) {
    EXPECT_NEAR(oklab_hue_difference_deg({0.3, 1.0, 0.0}, {0.9, 0.0, 2.0}), 90.0, 1e-12);
    EXPECT_NEAR(oklab_hue_difference_deg({0.3, -1.0, 0.1}, {0.9, -1.0, -0.1}), 11.4212, 1e-4);
}

}  // namespace

}  // namespace rowland::colour
