#include <gtest/gtest.h>

#include <variant>
#include <vector>

#include "editor/inspector/physics/order_panes.h"
#include "engine/colour/metal.h"

namespace rowland::inspector {
namespace {

using diffraction::Grating;

std::vector<Grating> gratings() {
    const Grating slit{.pitch_nm = 1600.0, .profile = diffraction::SlitProfile{800.0}, .metal = colour::Metal::Al};
    Grating dense = slit;
    dense.pitch_nm = 320.0;
    dense.profile = diffraction::LamellarProfile{.duty = 0.5, .depth_nm = 60.0};
    Grating blazed = slit;
    blazed.profile = diffraction::BlazedProfile{250.0};
    blazed.metal.reset();
    Grating agu = slit;
    agu.normalization = diffraction::Normalization::Agu;
    Grating table{.pitch_nm = 1600.0, .orders = {-1, 1}};
    table.profile =
        diffraction::EfficiencyTable{.orders = {-1, 0, 1}, .slices = {{0.0, {400.0, 700.0}, {.2, .3, .2, .1, .4, .3}}}};
    Grating dyed = slit;
    dyed.cover = diffraction::Cover{.ior = 1.58, .tint = {0.25, 0.45, 0.9}};
    return {slit, dense, blazed, agu, table, dyed};
}

TEST(EnergyBalance, FractionsSumToOne) {
    for (const Grating& grating : gratings())
        for (const double nm : {400.0, 550.0, 700.0})
            for (const double s_g : {-0.9, 0.0, 0.5}) {
                const EnergyBalance b = energy_balance(grating, nm, s_g);
                for (const double part : {b.orders, b.zero, b.evanescent, b.absorbed, b.rest}) EXPECT_GE(part, 0.0);
                // Sums of five doubles near 1.
                EXPECT_NEAR(b.orders + b.zero + b.evanescent + b.absorbed + b.rest, 1.0, 1e-12);
            }
}

TEST(EnergyBalance, ASlitsFractionsAreThoseOfTheFormula) {
    const Grating slit = gratings()[0];
    const EnergyBalance b = energy_balance(slit, 550.0, 0.0);
    const double r = colour::metal_reflectance(colour::Metal::Al, 550.0);
    // Half of the pitch reflects: η_0 = R/4, η_±1 = R/π², η_±2 = 0, all of which leave at normal incidence.
    EXPECT_NEAR(b.zero, r / 4.0, 1e-12);
    EXPECT_NEAR(b.orders, 2.0 * r / (3.14159265358979 * 3.14159265358979), 1e-12);
    EXPECT_NEAR(b.absorbed, 1.0 - r, 1e-12);
    EXPECT_EQ(b.evanescent, 0.0);
}

TEST(EnergyBalance, OrdersThatCannotLeaveAreEvanescent) {
    const Grating dense = gratings()[1];  // 320 nm: at normal incidence no order of 550 nm leaves
    const EnergyBalance straight = energy_balance(dense, 550.0, 0.0);
    EXPECT_EQ(straight.orders, 0.0);
    EXPECT_GT(straight.evanescent, 0.1);
    const EnergyBalance grazing = energy_balance(dense, 550.0, 0.9);  // +1: 1.72 − 0.9 < 1
    EXPECT_NEAR(grazing.orders, straight.evanescent / 2.0, 1e-12);
}

TEST(EnergyBalance, ATableAbsorbsWhatItsOrdersLeaveOver) {
    EXPECT_NEAR(energy_balance(gratings()[4], 400.0, 0.0).absorbed, 0.3, 1e-12);
    EXPECT_NEAR(energy_balance(gratings()[4], 700.0, 0.0).absorbed, 0.2, 1e-12);
}

}  // namespace
}  // namespace rowland::inspector
