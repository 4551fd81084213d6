#include "modules/diffraction/model/efficiency.h"

#include <gtest/gtest.h>

namespace rowland::diffraction {
namespace {

Grating slit() {
    Grating grating;
    grating.pitch_nm = 1600.0;
    grating.profile = SlitProfile{800.0};
    return grating;
}

TEST(Efficiency, MetalScalesEveryOrder) {
    Grating grating = slit();
    const double bare = order_efficiency(grating, 1, 500.0);
    const double bare_mirror = zero_order_efficiency(grating, 500.0);
    grating.metal = colour::Metal::Au;
    const double reflectance = colour::metal_reflectance(colour::Metal::Au, 500.0);
    EXPECT_DOUBLE_EQ(order_efficiency(grating, 1, 500.0), bare * reflectance);
    EXPECT_DOUBLE_EQ(zero_order_efficiency(grating, 500.0), bare_mirror * reflectance);
    EXPECT_DOUBLE_EQ(bare_mirror, 0.25);
}

TEST(Efficiency, AguWeighsByWavelengthAndAgreesAt550nm) {
    const Grating energy = slit();
    Grating agu = slit();
    agu.normalization = Normalization::Agu;
    EXPECT_DOUBLE_EQ(order_efficiency(agu, 1, 550.0), order_efficiency(energy, 1, 550.0));
    EXPECT_DOUBLE_EQ(order_efficiency(agu, -1, 440.0), 0.8 * order_efficiency(energy, -1, 440.0));
    // Order 0 is the same fraction of power under either normalization.
    EXPECT_DOUBLE_EQ(zero_order_efficiency(agu, 440.0), zero_order_efficiency(energy, 440.0));
}

TEST(Efficiency, FractionalOrderMeetsTheWholeOne) {
    Grating grating = slit();
    grating.metal = colour::Metal::Cu;
    EXPECT_NEAR(fractional_order_efficiency(grating, 1.0, 500.0), order_efficiency(grating, 1, 500.0), 1e-15);
}

}  // namespace
}  // namespace rowland::diffraction
