#include "modules/diffraction/model/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/support/csv.h"
#include "tests/support/test_data.h"

namespace rowland::diffraction {
namespace {

using std::numbers::pi;
constexpr double kCdPitch_nm = 1600.0;
constexpr double kWavelength_nm = 550.0;

/// The number after `name=` in a parameter text.
double parameter(const std::string& text, const std::string& name) {
    const auto at = text.find(name + "=");
    EXPECT_NE(at, std::string::npos) << text;
    return std::stod(text.substr(at + name.size() + 1));
}

/// A groove depth whose phase φ = 4πt/λ is `phase`.
double depth_of(double phase) {
    return phase * kWavelength_nm / (4.0 * pi);
}

Profile profile_of(const std::string& name, const std::string& parameters) {
    if (name == "binary_phase")
        return LamellarProfile{parameter(parameters, "duty"), depth_of(parameter(parameters, "phase_step"))};
    // The table's phase amplitude is J_m's argument, φ/2.
    if (name == "sinusoidal_phase") return SinusoidalProfile{depth_of(2.0 * parameter(parameters, "phase_amplitude"))};
    if (name == "blazed_phase") return BlazedProfile{depth_of(2.0 * pi * parameter(parameters, "blaze_order"))};
    EXPECT_EQ(name, "amplitude_ronchi");
    return SlitProfile{parameter(parameters, "open_fraction") * kCdPitch_nm};
}

/// Twelve printed decimals, parameters printed to six (duty) and nine (phase): 1e-6.
TEST(Profile, MatchesPublishedScalarEfficiencies) {
    ROWLAND_TEST_DATA(path, "data/facts/grating_efficiencies_scalar.csv");
    const test::Csv facts = test::read_csv(path);
    ASSERT_EQ(facts.rows.size(), 193U);
    for (std::size_t row = 0; row < facts.rows.size(); ++row) {
        const Profile profile = profile_of(facts.text(row, "profile"), facts.text(row, "parameter"));
        const double found = profile_efficiency(profile, kCdPitch_nm, facts.integer(row, "order"), kWavelength_nm);
        EXPECT_NEAR(found, facts.number(row, "efficiency"), 1e-6)
            << facts.text(row, "profile") << " " << facts.text(row, "parameter") << " order "
            << facts.text(row, "order");
    }
}

double sum_of_orders(const Profile& profile, int highest) {
    double sum = 0.0;
    for (int order = -highest; order <= highest; ++order)
        sum += profile_efficiency(profile, kCdPitch_nm, order, kWavelength_nm);
    return sum;
}

/// The tail beyond order M of Σ sinc² falls as 1/(π² M): 2e-5 at M = 10 000.
TEST(Profile, SlitOrdersSumToFillFactor) {
    for (const double fill : {0.1, 0.5, 0.9})
        EXPECT_NEAR(sum_of_orders(SlitProfile{fill * kCdPitch_nm}, 10000), fill, 3e-5) << fill;
}

/// Parseval: a phase grating sends all it gets somewhere. Tails as above; the sinusoid's vanish.
TEST(Profile, PhaseGratingOrdersSumToOne) {
    EXPECT_NEAR(sum_of_orders(LamellarProfile{0.43, 100.0}, 10000), 1.0, 1e-4);
    EXPECT_NEAR(sum_of_orders(BlazedProfile{260.0}, 10000), 1.0, 3e-5);
    EXPECT_NEAR(sum_of_orders(SinusoidalProfile{150.0}, 40), 1.0, 1e-12);
}

/// No setting makes more light than falls in: 400 random ones a profile. Sums of squares of closed forms: rounding.
TEST(Profile, OrdersNeverSumToMoreThanOne) {
    std::mt19937 generator(11);
    std::uniform_real_distribution<double> unit(0.001, 0.999);
    const std::vector<std::function<Profile()>> draws = {
        [&] { return SlitProfile{kCdPitch_nm * unit(generator)}; },
        [&] {
            return LamellarProfile{unit(generator), 1500.0 * unit(generator)};
        },
        [&] { return SinusoidalProfile{1500.0 * unit(generator)}; },
        [&] { return BlazedProfile{1500.0 * unit(generator)}; }};
    for (const auto& draw : draws) {
        double largest = 0.0;
        for (int i = 0; i < 400; ++i) {
            const Profile profile = draw();
            const double wavelength_nm = 380.0 + 400.0 * unit(generator);
            double sum = 0.0;
            for (int order = -200; order <= 200; ++order)
                sum += profile_efficiency(profile, kCdPitch_nm, order, wavelength_nm);
            largest = std::max(largest, sum);
        }
        EXPECT_LE(largest, 1.0 + 1e-12) << draw().index();
        EXPECT_GT(largest, 0.99) << draw().index();
    }
}

TEST(Profile, FullWidthSlitIsAMirror) {
    const SlitProfile mirror{kCdPitch_nm};
    EXPECT_EQ(profile_efficiency(mirror, kCdPitch_nm, 0, kWavelength_nm), 1.0);
    for (const int order : {-200, -3, -1, 1, 2, 7})
        EXPECT_EQ(profile_efficiency(mirror, kCdPitch_nm, order, kWavelength_nm), 0.0);
}

TEST(Profile, NarrowSlitVanishesWithoutNaN) {
    EXPECT_NEAR(profile_efficiency(SlitProfile{1e-6}, kCdPitch_nm, 1, kWavelength_nm), 0.0, 1e-17);
    EXPECT_EQ(profile_efficiency(SlitProfile{0.0}, kCdPitch_nm, 1, kWavelength_nm), 0.0);
}

TEST(Profile, FlatPhaseGratingsAreMirrors) {
    for (const Profile& profile :
         {Profile{LamellarProfile{0.3, 0.0}}, Profile{SinusoidalProfile{0.0}}, Profile{BlazedProfile{0.0}}}) {
        EXPECT_EQ(profile_efficiency(profile, kCdPitch_nm, 0, kWavelength_nm), 1.0);
        EXPECT_EQ(profile_efficiency(profile, kCdPitch_nm, 1, kWavelength_nm), 0.0);
    }
}

TEST(Profile, BlazeFavoursPositiveOrders) {
    const BlazedProfile blazed{0.5 * kWavelength_nm};  // one wavelength of path: all light in order 1
    EXPECT_NEAR(profile_efficiency(blazed, kCdPitch_nm, 1, kWavelength_nm), 1.0, 1e-15);
    EXPECT_NEAR(profile_efficiency(blazed, kCdPitch_nm, -1, kWavelength_nm), 0.0, 1e-15);
}

/// A groove's spectrum at the orders is their efficiency, by definition; both are closed forms.
TEST(Profile, GrooveSpectrumAtWholeOrdersIsTheEfficiency) {
    for (const Profile& profile : {Profile{SlitProfile{500.0}}, Profile{LamellarProfile{0.35, 130.0}},
                                   Profile{SinusoidalProfile{150.0}}, Profile{BlazedProfile{260.0}}})
        for (int order = -4; order <= 4; ++order)
            EXPECT_NEAR(groove_spectrum(profile, kCdPitch_nm, order, kWavelength_nm),
                        profile_efficiency(profile, kCdPitch_nm, order, kWavelength_nm), 1e-14)
                << "profile " << profile.index() << " order " << order;
}

/// The slow reference: |∫ exp(iφ(y)) exp(−2πi x y) dy|² by the midpoint rule, 1e5 nodes (error ~1e-9 smooth, ~1e-5 at
/// steps).
TEST(Profile, GrooveSpectrumIsTheGroovesFourierTransform) {
    const double x = 1.37;
    const auto brute_force = [&](const auto& depth_nm) {
        double re = 0.0;
        double im = 0.0;
        const int nodes = 100000;
        for (int i = 0; i < nodes; ++i) {
            const double y = (i + 0.5) / nodes - 0.5;
            const double phase = 4.0 * pi * depth_nm(y) / kWavelength_nm - 2.0 * pi * x * y;
            re += std::cos(phase) / nodes;
            im += std::sin(phase) / nodes;
        }
        return re * re + im * im;
    };
    EXPECT_NEAR(groove_spectrum(LamellarProfile{0.35, 130.0}, kCdPitch_nm, x, kWavelength_nm),
                brute_force([](double y) { return std::abs(y) < 0.175 ? 130.0 : 0.0; }), 2e-5);
    EXPECT_NEAR(groove_spectrum(SinusoidalProfile{150.0}, kCdPitch_nm, x, kWavelength_nm),
                brute_force([](double y) { return 75.0 * std::cos(2.0 * pi * y); }), 1e-8);
    EXPECT_NEAR(groove_spectrum(BlazedProfile{260.0}, kCdPitch_nm, x, kWavelength_nm),
                brute_force([](double y) { return 260.0 * y; }), 1e-8);
}

}  // namespace
}  // namespace rowland::diffraction
