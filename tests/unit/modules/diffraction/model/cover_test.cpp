#include "modules/diffraction/model/cover.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/colour/light_spectra.h"
#include "modules/diffraction/model/efficiency.h"

namespace rowland::diffraction {
namespace {

/// 1 − the mean of the squared amplitudes, as textbooks print them, by the two angles (Born & Wolf, §1.5).
double by_angles(double ior, double cosine) {
    const double outside = std::acos(cosine);
    const double inside = std::asin(std::sin(outside) / ior);
    const double across = std::sin(outside - inside) / std::sin(outside + inside);
    const double along = std::tan(outside - inside) / std::tan(outside + inside);
    return 1.0 - 0.5 * (across * across + along * along);
}

TEST(Cover, TransmittanceIsFresnels) {
    for (const double ior : {1.1, 1.33, 1.58, 2.42})
        for (const double cosine : {1e-3, 0.05, 0.3, 0.7, 0.95})
            EXPECT_NEAR(transmittance(ior, cosine), by_angles(ior, cosine), 1e-12) << ior << " " << cosine;
    for (const double ior : {1.33, 1.58})
        EXPECT_NEAR(transmittance(ior, 1.0), 4.0 * ior / ((ior + 1.0) * (ior + 1.0)), 1e-15);
}

TEST(Cover, EndsOfTheRange) {
    EXPECT_EQ(transmittance(1.58, 0.0), 0.0);
    EXPECT_EQ(transmittance(1.58, -0.5), 0.0);
    EXPECT_NEAR(transmittance(1.0, 1e-6), 1.0, 1e-15);
    EXPECT_GT(transmittance(3.0, 1e-12), 0.0);
    EXPECT_EQ(transmittance(std::optional<Cover>(), 1e-3), 1.0);
}

Grating pressed() {
    return {.pitch_nm = 1600.0, .profile = LamellarProfile{.duty = 0.35, .depth_nm = 130.0}};
}

/// Published beside the formula, to the digits printed: such a disc loses its blue first order.
TEST(Cover, TurnsTheFirstOrderOfAPressedDiscRed) {
    Grating grating = pressed();
    const double nm[] = {450.0, 550.0, 650.0};
    const double in_air[] = {0.303, 0.319, 0.291};
    const double covered[] = {0.024, 0.164, 0.270};
    for (int i = 0; i < 3; ++i) {
        grating.cover.reset();
        EXPECT_NEAR(order_efficiency(grating, 1, nm[i]), in_air[i], 6e-4);
        grating.cover = Cover{};
        EXPECT_NEAR(order_efficiency(grating, 1, nm[i]), covered[i], 6e-4);
        // As between the orders of few grooves.
        EXPECT_NEAR(fractional_order_efficiency(grating, 1.0, nm[i]), order_efficiency(grating, 1, nm[i]), 1e-14);
    }
}

TEST(Cover, MetalsReflectLessUnderIt) {
    Grating grating = pressed();
    grating.metal = colour::Metal::Al;
    EXPECT_NEAR(reflectance(grating, 550.0), 0.921, 5e-3);
    grating.cover = Cover{};
    EXPECT_NEAR(reflectance(grating, 550.0), 0.882, 5e-3);
}

TEST(Cover, ATintIsPassedTwice) {
    Grating grating = pressed();
    grating.cover = Cover{};
    const double clear = order_efficiency(grating, 1, 610.0);
    const double clear_mirror = zero_order_efficiency(grating, 610.0);
    grating.cover->tint = {0.25, 0.45, 0.9};
    const glm::dvec3 basis = colour::rgb_basis(610.0);
    const double once = 0.25 * basis.r + 0.45 * basis.g + 0.9 * basis.b;
    EXPECT_NEAR(order_efficiency(grating, 1, 610.0), once * once * clear, 1e-15);
    EXPECT_NEAR(zero_order_efficiency(grating, 610.0), once * once * clear_mirror, 1e-15);
}

TEST(Cover, ATableIsTakenAsItIs) {
    Grating grating{.pitch_nm = 1600.0,
                    .profile = EfficiencyTable{.orders = {0, 1},
                                               .slices = {{.wavelengths_nm = {500.0}, .efficiencies = {0.5, 0.3}}}}};
    grating.cover = Cover{.ior = 1.58, .tint = {0.1, 0.1, 0.1}};
    EXPECT_EQ(order_efficiency(grating, 1, 500.0), 0.3);
    EXPECT_EQ(zero_order_efficiency(grating, 500.0), 0.5);
}

}  // namespace
}  // namespace rowland::diffraction
