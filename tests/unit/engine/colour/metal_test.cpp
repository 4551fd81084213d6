#include "engine/colour/metal.h"

#include <gtest/gtest.h>

namespace rowland::colour {
namespace {

/// Handbook reflectances of evaporated films at normal incidence (CRC Handbook, "Optical properties of metals"), whose
/// samples differ from author to author by a few per cent.
TEST(Metal, ReflectsAsHandbooksSay) {
    EXPECT_NEAR(metal_reflectance(Metal::Al, 550.0), 0.915, 0.02);
    EXPECT_NEAR(metal_reflectance(Metal::Ag, 550.0), 0.96, 0.03);
    EXPECT_NEAR(metal_reflectance(Metal::Au, 450.0), 0.38, 0.04);
    EXPECT_NEAR(metal_reflectance(Metal::Au, 650.0), 0.95, 0.04);
    EXPECT_NEAR(metal_reflectance(Metal::Cu, 500.0), 0.55, 0.07);
    EXPECT_NEAR(metal_reflectance(Metal::Cu, 650.0), 0.94, 0.05);
}

TEST(Metal, ReflectanceIsAShareAtEveryWavelength) {
    for (const Metal metal : {Metal::Al, Metal::Ag, Metal::Au, Metal::Cu})
        for (int wavelength_nm = 200; wavelength_nm <= 1000; ++wavelength_nm) {
            EXPECT_GT(metal_reflectance(metal, wavelength_nm), 0.0);
            EXPECT_LT(metal_reflectance(metal, wavelength_nm), 1.0);
        }
}

TEST(Metal, NamesRoundTrip) {
    for (const Metal metal : {Metal::Al, Metal::Ag, Metal::Au, Metal::Cu})
        EXPECT_EQ(parse_metal(metal_name(metal)), metal);
    EXPECT_FALSE(parse_metal("al"));
    EXPECT_FALSE(parse_metal("Fe"));
}

}  // namespace
}  // namespace rowland::colour
