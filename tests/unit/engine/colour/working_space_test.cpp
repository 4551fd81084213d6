#include "engine/colour/working_space.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/colour/light_spectra.h"
#include "tests/support/expect_near.h"

namespace rowland::colour {
namespace {

using rowland::test::expect_near;

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

}  // namespace
}  // namespace rowland::colour
