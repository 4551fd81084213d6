#include "engine/colour/light_spectra.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "engine/colour/working_space.h"

namespace rowland::colour {
namespace {

/// The published basis sums to 1 within 1e-5 (its printed digits).
TEST(LightSpectra, BasisSharesSumToOne) {
    for (int wavelength_nm = kVisibleMin; wavelength_nm <= kVisibleMax; ++wavelength_nm) {
        const glm::dvec3 share = rgb_basis(wavelength_nm);
        EXPECT_NEAR(share.r + share.g + share.b, 1.0, 1.1e-5) << wavelength_nm;
    }
}

/// Y to the basis' sum, chromaticity to the four digits that define D65 (ITU-R BT.709: 0.3127,
/// 0.3290): half a digit, and the 1e-5 that cutting the range to 380–780 nm takes.
TEST(LightSpectra, WhiteHasUnitLuminanceAndD65Chromaticity) {
    const glm::dvec3 white = rgb_to_xyz(LightSpectra(), glm::dvec3(1.0));
    EXPECT_NEAR(white.y, 1.0, 1e-5);
    EXPECT_NEAR(white.x / (white.x + white.y + white.z), 0.3127, 6e-5);
    EXPECT_NEAR(white.y / (white.x + white.y + white.z), 0.3290, 6e-5);
}

/// The basis is fitted to sRGB at 8 bits; it is within 8.3e-4 of the matrix, a fifth of an 8-bit step (measured).
TEST(LightSpectra, RgbToXyzIsTheRec709Matrix) {
    const LightSpectra spectra;
    for (int c = 0; c < 3; ++c) {
        glm::dvec3 rgb(0.0);
        rgb[c] = 1.0;
        const glm::dvec3 difference = rgb_to_xyz(spectra, rgb) - rec709_to_xyz() * rgb;
        EXPECT_LT(glm::length(difference), 9e-4) << "channel " << c;
    }
}

TEST(LightSpectra, AreRelativeToTheIlluminantsOwnWhite) {
    const LightSpectra spectra{illuminant("A")};
    const glm::dvec3 white = rgb_to_xyz(spectra, glm::dvec3(1.0));
    EXPECT_NEAR(white.y, 1.0, 1e-5);
    EXPECT_NEAR(white.x / (white.x + white.y + white.z), 0.4476, 1e-3);
}

}  // namespace
}  // namespace rowland::colour
