#include "modules/diffraction/asset/layer_weights.h"

#include <gtest/gtest.h>

#include <numbers>

namespace rowland::diffraction {
namespace {

constexpr double kPi = std::numbers::pi;
// The RGB basis' three columns sum to 1 to 1e-11, the digits of its table.
constexpr double kTolerance = 1e-11;

TEST(LayerWeights, SlitWithoutMetalLeavesWhatItsOrdersDoNotCarry) {
    Grating grating{.pitch_nm = 1600.0, .profile = SlitProfile{.width_nm = 800.0}};
    const LayerWeights weights = layer_weights(grating);
    // η₀ = (b/d)² = ¼; η±1 = ¼ sinc²(½) = 1/π²; η±2 = 0. White light keeps Y = 1, by the illuminant's normalisation.
    EXPECT_NEAR(weights.mirror.y, 0.25, kTolerance);
    EXPECT_NEAR(weights.base.y, 1.0 - 0.25 - 2.0 / (kPi * kPi), kTolerance);
}

TEST(LayerWeights, AListedZeroOrderIsNotLeftToTheEngine) {
    Grating grating{.pitch_nm = 1600.0, .profile = SlitProfile{.width_nm = 800.0}, .orders = {0, 1}};
    const LayerWeights weights = layer_weights(grating);
    EXPECT_EQ(weights.mirror, glm::dvec3(0.0));
    EXPECT_NEAR(weights.base.y, 1.0 - 0.25 - 1.0 / (kPi * kPi), kTolerance);
}

TEST(LayerWeights, GoldTintsTheZeroOrder) {
    Grating grating{.pitch_nm = 1600.0, .profile = SlitProfile{.width_nm = 800.0}, .metal = colour::Metal::Au};
    const LayerWeights weights = layer_weights(grating);
    EXPECT_LT(weights.mirror.y, 0.25);
    EXPECT_LT(weights.mirror.z, 0.7 * weights.mirror.y);  // gold takes the blue
}

}  // namespace
}  // namespace rowland::diffraction
