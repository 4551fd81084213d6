#include "modules/diffraction/model/lobe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "modules/diffraction/model/profile.h"

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

/// PHYSICS (3.5), the slow sum over all orders: of each spacing a lamellar relief of duty ½ whose order 0 is κ.
double pit_sequence_density(const PitSequenceLobe& lobe, double z, double wavelength_nm) {
    const double cancelled = std::asin(std::sqrt(1.0 - lobe.coherent)) / std::numbers::pi;  // of φ/2 = 2πt/λ
    const LamellarProfile relief{.duty = 0.5, .depth_nm = 0.5 * cancelled * wavelength_nm};
    double sum = 0.0;
    for (const double spacing_nm : lobe.spacings_nm)
        for (int order = -60; order <= 60; ++order)
            sum += profile_efficiency(relief, spacing_nm, order, wavelength_nm) *
                   lobe_density(GaussianLobe{lobe.sigma}, z - order * wavelength_nm / spacing_nm, wavelength_nm);
    return sum / static_cast<double>(lobe.spacings_nm.size());
}

/// 1e-12: the slow sum's 121 terms.
TEST(Lobe, APitSequenceIsTheOrdersOfAHalfFilledGratingForEachSpacing) {
    for (const double coherent : {0.0, 0.3, 1.0})
        for (const double sigma : {0.005, 0.02, 0.1}) {
            PitSequenceLobe lobe;
            lobe.coherent = coherent;
            lobe.sigma = sigma;
            for (const double wavelength_nm : {380.0, 550.0, 780.0})
                for (const double z : {0.0, 0.17, -0.4, 0.9, 1.7, -2.0})
                    EXPECT_NEAR(lobe_density(lobe, z, wavelength_nm), pit_sequence_density(lobe, z, wavelength_nm),
                                1e-12 * lobe_density(lobe, 0.0, wavelength_nm) + 1e-12)
                        << coherent << " " << sigma << " " << z;
        }
}

/// Over ±20 the orders beyond ±20 b/λ are missing: 4/π² λ/(20 b) of the incoherent part, .9 % at most. No interval of
/// length 2 holds more than 1.
TEST(Lobe, APitSequenceIntegratesToOneAndNeverAddsPower) {
    for (const double coherent : {0.0, 0.4})
        for (const double sigma : {0.02, 0.2})
            for (const double wavelength_nm : {380.0, 780.0}) {
                PitSequenceLobe lobe;
                lobe.coherent = coherent;
                lobe.sigma = sigma;
                const LobeDensity density(lobe, wavelength_nm);
                constexpr double kStep = 0.002;
                constexpr std::size_t kInterval = 1000;  // nodes of an interval of length 2
                std::vector<double> sums{0.0};
                for (int i = -10000; i < 10000; ++i) sums.push_back(sums.back() + kStep * density((i + 0.5) * kStep));
                double largest = 0.0;
                for (std::size_t i = kInterval; i < sums.size(); ++i)
                    largest = std::max(largest, sums[i] - sums[i - kInterval]);
                EXPECT_LT(sums.back(), 1.0 + 1e-6);  // 1/erf(1/(σ√2)) of σ = .2 is 1 + 6e-7
                EXPECT_GT(sums.back(), 0.99);
                EXPECT_LT(largest, 1.0 + 1e-6);
            }
}

TEST(Lobe, AWhollyCoherentPitSequenceIsTheGaussian) {
    const PitSequenceLobe lobe{.spacings_nm = {900.0, 1200.0}, .coherent = 1.0, .sigma = 0.03};
    for (const double z : {-0.07, 0.0, 0.03, 1.4})
        EXPECT_EQ(lobe_density(lobe, z, 550.0), lobe_density(GaussianLobe{0.03}, z, 550.0));
    EXPECT_EQ(lobe_extent(lobe).half_width, lobe_extent(GaussianLobe{0.03}).half_width);
}

TEST(Lobe, APitSequenceBendsOverSigmaEverywhere) {
    const PitSequenceLobe lobe;
    EXPECT_EQ(lobe_extent(lobe).half_width, 2.0);
    EXPECT_EQ(lobe_extent(lobe).core_half_width, 2.0);
    EXPECT_EQ(lobe_extent(lobe).feature_size, kCoherentSigma);
    EXPECT_EQ(lobe_extent(lobe).tail_feature_size, kCoherentSigma);
    EXPECT_FALSE(is_flat(lobe));
}

TEST(Lobe, OnlyPitsAndPitSequencesDependOnTheWavelength) {
    EXPECT_FALSE(depends_on_wavelength(FlatLobe{}));
    EXPECT_FALSE(depends_on_wavelength(GaussianLobe{}));
    EXPECT_TRUE(depends_on_wavelength(PitsLobe{}));
    EXPECT_TRUE(depends_on_wavelength(PitSequenceLobe{}));
}

/// The orders sum to the density of the lobe.
TEST(Lobe, OrdersOfAPitSequenceAreItsDensity) {
    const PitSequenceLobe lobe;
    for (const double z : {0.0, 0.3, -0.8}) {
        double sum = 0.0;
        for (const PitOrder& order : pit_orders(lobe, 550.0, 2.0))
            sum += order.power * lobe_density(GaussianLobe{lobe.sigma}, z - order.centre, 550.0);
        EXPECT_NEAR(sum, lobe_density(lobe, z, 550.0), 1e-12);
    }
}

}  // namespace
}  // namespace rowland::diffraction
