#include "modules/diffraction/model/lobe.h"

#include <gtest/gtest.h>

#include <numbers>

namespace rowland::diffraction {
namespace {

TEST(Lobe, IntegratesToOne) {
    for (const GrooveLobe& lobe :
         {GrooveLobe{FlatLobe{}}, GrooveLobe{GaussianLobe{0.02}}, GrooveLobe{GaussianLobe{0.2}},
          GrooveLobe{GaussianLobe{0.7}}, GrooveLobe{GaussianLobe{50.0}}}) {
        double sum = 0.0;
        const int nodes = 20000;  // midpoint rule: 1e-9 of a bump 0.02 wide
        for (int i = 0; i < nodes; ++i) sum += lobe_density(lobe, (i + 0.5) * 2.0 / nodes - 1.0, 550.0) * 2.0 / nodes;
        EXPECT_NEAR(sum, 1.0, 1e-8);
    }
}

/// exp(−½(s/σ)²) is flat to (1/σ)²/2 at σ = 1e4, and exactly flat in double at 1e9 and beyond.
TEST(Lobe, WideGaussianTendsToFlat) {
    EXPECT_NEAR(lobe_density(GaussianLobe{1e4}, 0.7, 550.0), 0.5, 1e-8);
    EXPECT_NEAR(lobe_density(GaussianLobe{1e150}, 0.7, 550.0), 0.5, 1e-12);
}

TEST(Lobe, NarrowGaussianIsFinite) {
    EXPECT_GT(lobe_density(GaussianLobe{1e-9}, 0.0, 550.0), 1e8);
    EXPECT_EQ(lobe_density(GaussianLobe{1e-9}, 0.1, 550.0), 0.0);
}

TEST(Lobe, IsBelowAnyNoticeBeyondItsHalfWidth) {
    const GaussianLobe lobe{0.1};
    EXPECT_LT(lobe_density(lobe, lobe_extent(lobe).half_width, 550.0), 1e-15 * lobe_density(lobe, 0.0, 550.0));
    EXPECT_EQ(lobe_extent(GaussianLobe{3.0}).half_width, 2.0);
    EXPECT_EQ(lobe_extent(FlatLobe{}).half_width, 2.0);
}

/// PHYSICS §3: κ·G + (1−κ)·(ℓ/λ) sinc²(ℓz/λ), here at its peak, its first zero and between. 0.0794: G at 2.5 σ.
TEST(Lobe, PitsAreACoherentBumpAndASincSquared) {
    const PitsLobe pits{.length_nm = 1100.0, .coherent = 0.3};
    const double peak = 1.0 / (kCoherentSigma * std::sqrt(2.0 * std::numbers::pi));
    EXPECT_NEAR(lobe_density(pits, 0.0, 550.0), 0.3 * peak + 0.7 * 2.0, 1e-12);
    EXPECT_NEAR(lobe_density(pits, 0.5, 550.0), 0.0, 1e-15);
    EXPECT_NEAR(lobe_density(pits, 0.25, 550.0), 0.7 * 2.0 * 4.0 / (std::numbers::pi * std::numbers::pi), 1e-12);
    EXPECT_NEAR(lobe_density(pits, 0.05, 550.0) -
                    0.7 * 2.0 * std::pow(std::sin(0.1 * std::numbers::pi) / (0.1 * std::numbers::pi), 2),
                0.3 * peak * std::exp(-3.125), 1e-12);
}

TEST(Lobe, PitsWidenWithWavelength) {
    const PitsLobe pits{.length_nm = 850.0, .coherent = 0.0};
    EXPECT_GT(lobe_density(pits, 0.6, 700.0), lobe_density(pits, 0.6, 450.0));
    EXPECT_NEAR(lobe_density(pits, 450.0 / 850.0, 450.0), 0.0, 1e-15);
}

TEST(Lobe, WhollyCoherentPitsAreTheGaussian) {
    const PitsLobe pits{.length_nm = 850.0, .coherent = 1.0};
    for (const double z : {-0.07, 0.0, 0.03, 1.4})
        EXPECT_EQ(lobe_density(pits, z, 550.0), lobe_density(GaussianLobe{kCoherentSigma}, z, 550.0));
    EXPECT_EQ(lobe_extent(pits).half_width, lobe_extent(GaussianLobe{kCoherentSigma}).half_width);
}

TEST(Lobe, PitsAreSplitAtTheirBump) {
    const PitsLobe pits{.length_nm = 850.0, .coherent = 0.3};
    EXPECT_EQ(lobe_extent(pits).half_width, 2.0);
    EXPECT_EQ(lobe_extent(pits).core_half_width, lobe_extent(GaussianLobe{kCoherentSigma}).half_width);
    EXPECT_EQ(lobe_extent(PitsLobe{850.0, 0.0}).core_half_width, 2.0);
    EXPECT_EQ(lobe_extent(pits).feature_size, kCoherentSigma);
    EXPECT_EQ(lobe_extent(PitsLobe{38000.0, 0.3}).feature_size, 0.01);
    EXPECT_FALSE(is_flat(pits));
}

}  // namespace
}  // namespace rowland::diffraction
