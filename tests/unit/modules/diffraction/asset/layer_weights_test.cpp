#include "modules/diffraction/asset/material.h"

#include <gtest/gtest.h>

namespace rowland::diffraction {
namespace {

using std::numbers::pi;
// The RGB basis' three columns sum to 1 to 1e-11, the digits of its table.
constexpr double kTolerance = 1e-11;

/// Luminance of white light after the orders that the diffraction term shades.
double white_of_listed_orders(const Grating& grating) {
    const colour::LightSpectra spectra;
    double sum = 0.0;
    for (int wavelength_nm = 380; wavelength_nm <= 780; ++wavelength_nm) {
        const glm::dvec3 e = spectra(wavelength_nm);
        const double step_nm = wavelength_nm == 380 || wavelength_nm == 780 ? 0.5 : 1.0;
        for (const int order : grating.orders)
            sum += step_nm * order_efficiency(grating, order, wavelength_nm) * (e.r + e.g + e.b) *
                   colour::cie_xyz(wavelength_nm).y;
    }
    return sum;
}

TEST(LayerWeights, SlitWithoutMetalLeavesWhatItsOrdersDoNotCarry) {
    Grating grating{.pitch_nm = 1600.0, .profile = SlitProfile{.width_nm = 800.0}};
    const LayerWeights weights = layer_weights(grating);
    // η₀ = (b/d)² = ¼; η±1 = ¼ sinc²(½) = 1/π²; η±2 = 0. White light keeps Y = 1, by the illuminant's normalisation.
    EXPECT_NEAR(weights.mirror.y, 0.25, kTolerance);
    EXPECT_NEAR(weights.base.y, 1.0 - 0.25 - 2.0 / (pi * pi), kTolerance);
}

TEST(LayerWeights, AListedZeroOrderIsNotLeftToTheEngine) {
    Grating grating{.pitch_nm = 1600.0, .profile = SlitProfile{.width_nm = 800.0}, .orders = {0, 1}};
    const LayerWeights weights = layer_weights(grating);
    EXPECT_EQ(weights.mirror, glm::dvec3(0.0));
    EXPECT_NEAR(weights.base.y, 1.0 - 0.25 - 1.0 / (pi * pi), kTolerance);
}

/// A relief whose listed orders are all that there are but a few per cent: both sides of a sheet take nearly all light.
TEST(LayerWeights, BothSidesOfASheetTakeFromTheBase) {
    Grating sheet{.pitch_nm = 2000.0,
                  .profile = SinusoidalProfile{.depth_nm = 100.0},
                  .orders = {-3, -2, -1, 1, 2, 3},
                  .transmission = Transmission{.ior = 1.5, .reflectance = 0.5}};
    EXPECT_LT(layer_weights(sheet).base.y, 0.01);
    EXPECT_GE(layer_weights(sheet).base.y, 0.0);
    const LayerWeights reflected = layer_weights(*reflected_side(sheet));
    EXPECT_EQ(reflected.base, glm::dvec3(0.0));
    EXPECT_LT(reflected.mirror.y, 0.5);
    EXPECT_LT(reflected.mirror.y, layer_weights(sheet).mirror.y);  // in reflection the relief is four times as deep
}

/// Mirror, base and listed orders share out white light: no more than came in, and, but where the orders alone take it
/// all, no less. A table's rows sum to 1.0004 here, which is scaled away.
TEST(LayerWeights, NothingComesOutThatDidNotFallIn) {
    const EfficiencyTable table{
        .orders = {-1, 0, 1},
        .slices = {{.wavelengths_nm = {400.0, 700.0}, .efficiencies = {0.3, 0.3, 0.4004, 0.1, 0.5, 0.4}}}};
    for (const Profile& profile :
         {Profile{SlitProfile{500.0}}, Profile{SlitProfile{1600.0}}, Profile{LamellarProfile{0.35, 130.0}},
          Profile{SinusoidalProfile{150.0}}, Profile{BlazedProfile{260.0}}, Profile{table}}) {
        for (const bool zero_listed : {false, true}) {
            Grating grating{.pitch_nm = 1600.0, .profile = profile, .orders = {-3, -2, -1, 1, 2, 3}};
            if (zero_listed) grating.orders.insert(grating.orders.begin() + 3, 0);
            const LayerWeights weights = layer_weights(grating);
            const double listed = white_of_listed_orders(grating);
            EXPECT_LE(weights.mirror.y + weights.base.y + listed, 1.0 + kTolerance) << profile.index();
            EXPECT_GE(weights.mirror.y + weights.base.y + listed, 1.0 - 1e-9) << profile.index();
        }
    }
}

/// Also of the peak form, which weighs orders by λ/550 nm: for a slit f² + (f − f²)·780/550 stays below 1.
TEST(LayerWeights, TheAguNormalisationAddsNoLightEither) {
    for (const double fill : {0.1, 0.5, 0.8, 0.95}) {
        Grating grating{.pitch_nm = 1600.0, .profile = SlitProfile{1600.0 * fill}};
        grating.normalization = Normalization::Agu;
        const LayerWeights weights = layer_weights(grating);
        EXPECT_LE(weights.mirror.y + weights.base.y + white_of_listed_orders(grating), 1.0 + kTolerance) << fill;
    }
}

/// What is neither in the listed orders of a lattice nor in its mirror's goes to the base.
TEST(LayerWeights, ScreensLeaveTheirRemainderToTheBase) {
    Grating screen;
    screen.lattice = Lattice{.a_nm = {50000.0, 0.0},
                             .b_nm = {0.0, 40000.0},
                             .profile = ApertureProfile{.width_nm = 15000.0, .height_nm = 40000.0},
                             .orders = 40};
    EXPECT_NEAR(layer_weights(screen).mirror.y, 0.3 * 0.3, 1e-9);
    EXPECT_NEAR(layer_weights(screen).base.y, 0.7, 5e-3);
}

}  // namespace
}  // namespace rowland::diffraction
