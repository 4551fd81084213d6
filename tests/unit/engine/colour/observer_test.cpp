#include "engine/colour/observer.h"

#include <gtest/gtest.h>

namespace rowland::colour {
namespace {

/// CIE 018:2019, 555 nm: x̄ = 0.5121, ȳ = 1.0000, z̄ = 0.0057 as printed.
TEST(Observer, HasThePublishedValuesAt555nm) {
    EXPECT_NEAR(cie_xyz(555.0).x, 0.5121, 5e-5);
    EXPECT_NEAR(cie_xyz(555.0).y, 1.0000, 5e-5);
    EXPECT_NEAR(cie_xyz(555.0).z, 0.0057, 1e-4);
}

/// The standard makes the three areas equal; the sums of its 1 nm table over 360–830 nm as CVRL prints them, to the
/// digit.
TEST(Observer, HasThePublishedSums) {
    glm::dvec3 sum(0.0);
    for (int wavelength_nm = 360; wavelength_nm <= 830; ++wavelength_nm) sum += cie_xyz(wavelength_nm);
    EXPECT_NEAR(sum.x, 106.8655, 1e-4);
    EXPECT_NEAR(sum.y, 106.8569, 1e-4);
    EXPECT_NEAR(sum.z, 106.8923, 1e-4);
}

TEST(Observer, SeesNothingOutsideItsTable) {
    EXPECT_EQ(cie_xyz(359.0), glm::dvec3(0.0));
    EXPECT_EQ(cie_xyz(831.0), glm::dvec3(0.0));
}

}  // namespace
}  // namespace rowland::colour
