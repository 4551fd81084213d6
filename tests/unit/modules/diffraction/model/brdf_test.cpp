#include "modules/diffraction/model/brdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "modules/diffraction/model/efficiency.h"
#include "modules/diffraction/model/grating_equation.h"

namespace rowland::diffraction {
namespace {

Grating slit(double grooves) {
    Grating grating;
    grating.pitch_nm = 1600.0;
    grating.profile = SlitProfile{600.0};
    grating.grooves = grooves;
    grating.orders = all_orders(grating.pitch_nm);
    return grating;
}

/// A unit vector above the surface with the given s_g.
glm::dvec3 direction(double s_g, double s_h) {
    return {s_g, s_h, std::sqrt(1.0 - s_g * s_g - s_h * s_h)};
}

TEST(Brdf, AguPeakIsTheSincOfTheFillFactor) {
    const Grating grating = slit(1500.0);
    const double wavelength_nm = 512.0;  // mλ/d is exact in binary: the peak itself is hit
    for (const int order : {-2, -1, 0, 1, 2, 3}) {
        const glm::dvec3 s = direction(0.25, 0.1);
        const glm::dvec3 v = direction(order * wavelength_nm / grating.pitch_nm - s.x, -0.2);
        const double expected = sinc(order * 600.0 / 1600.0) * sinc(order * 600.0 / 1600.0);
        // u rounds by 1e-16, which N = 1500 makes a phase of 1e-12.
        EXPECT_NEAR(brdf_agu(grating, s, v, wavelength_nm, 3.0), 3.0 * expected, 1e-10) << order;
    }
}

/// PHYSICS §3: f_A/f_E = 2λ/(N d (b/d)²) at every peak of a slit with a flat lobe.
TEST(Brdf, AguAndEnergyDifferByTheStatedRatio) {
    const Grating grating = slit(1500.0);
    for (const double wavelength_nm : {400.0, 550.0, 700.0})
        for (const int order : {-2, -1, 1, 2}) {
            const glm::dvec3 s = direction(0.05, 0.1);
            const glm::dvec3 v = direction(order * wavelength_nm / grating.pitch_nm - s.x, -0.2);
            const double ratio = brdf_agu(grating, s, v, wavelength_nm) / brdf_energy(grating, s, v, wavelength_nm);
            EXPECT_NEAR(ratio, 2.0 * wavelength_nm / (1500.0 * 1600.0 * std::pow(600.0 / 1600.0, 2)), 1e-12 * ratio);
        }
}

/// f(s, v) = f(v, s) to 1e-12 of it, for every profile, lobe and number of grooves. s and v enter as sums only.
TEST(Brdf, EnergyFormIsReciprocal) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-0.7, 0.7);
    const EfficiencyTable table{.orders = {-1, 0, 1},
                                .slices = {{.wavelengths_nm = {500.0}, .efficiencies = {0.1, 0.2, 0.4}}}};
    int lit = 0;
    for (const Profile& profile : {Profile{SlitProfile{500.0}}, Profile{LamellarProfile{0.35, 130.0}},
                                   Profile{SinusoidalProfile{150.0}}, Profile{BlazedProfile{260.0}}, Profile{table}}) {
        for (const GrooveLobe& lobe :
             {GrooveLobe{FlatLobe{}}, GrooveLobe{GaussianLobe{0.3}}, GrooveLobe{PitsLobe{850.0, 0.3}}}) {
            for (const double grooves : {1.0, 2.0, 20.0, 50.0, 1500.0}) {
                if (std::holds_alternative<EfficiencyTable>(profile) && grooves < kManyGrooves) continue;
                Grating grating{.pitch_nm = 1200.0, .grooves = grooves, .profile = profile, .lobe = lobe};
                grating.orders = all_orders(grating.pitch_nm);
                if (!std::holds_alternative<EfficiencyTable>(profile)) grating.metal = colour::Metal::Au;
                for (int i = 0; i < 50; ++i) {
                    const glm::dvec3 s = direction(uniform(generator), uniform(generator));
                    const glm::dvec3 v = direction(uniform(generator), uniform(generator));
                    const double forth = brdf_energy(grating, s, v, 530.0);
                    EXPECT_NEAR(forth, brdf_energy(grating, v, s, 530.0), 1e-12 * forth);
                    lit += forth > 0.0 ? 1 : 0;
                }
            }
        }
    }
    EXPECT_GT(lit, 1000);
}

/// ∫ f_E s_n dω over the hemisphere, dω s_n = dg dh, is the listed orders' efficiency where they propagate for certain.
TEST(Brdf, OrdersIntegrateToTheirEfficiency) {
    Grating grating = slit(60.0);
    grating.orders = {1};
    grating.lobe = GaussianLobe{0.1};  // its whole bump is inside the disc for v near the normal
    const double wavelength_nm = 500.0;
    const glm::dvec3 v = direction(0.0, 0.0);
    const int nodes = 4000;
    double sum = 0.0;
    for (int i = 0; i < nodes; ++i) {
        const double s_g = (i + 0.5) / nodes;
        for (int j = 0; j < 400; ++j) {
            const double s_h = (j + 0.5) / 400.0 * 1.6 - 0.8;
            if (s_g * s_g + s_h * s_h < 1.0)
                sum += brdf_energy(grating, direction(s_g, s_h), v, wavelength_nm) / nodes * 1.6 / 400.0;
        }
    }
    // Order 1's period, x ∈ [½, 3/2], lies in s_g ∈ [.16, .47]; the rule resolves the lobes of N = 60.
    EXPECT_NEAR(sum, order_efficiency(grating, 1, wavelength_nm), 1e-4 * sum);
}

TEST(Brdf, SubwavelengthPitchIsExactlyBlack) {
    Grating grating = slit(1500.0);
    grating.pitch_nm = 150.0;
    grating.profile = SlitProfile{75.0};
    grating.orders = all_orders(grating.pitch_nm);
    EXPECT_TRUE(grating.orders.empty());
    grating.orders = {-2, -1, 1, 2};
    for (const double s_g : {-0.9, 0.0, 0.9})
        EXPECT_EQ(brdf_energy(grating, direction(s_g, 0.0), direction(0.9, 0.0), 380.0), 0.0);
}

TEST(Brdf, IsBlackBelowTheSurfaceAndForOrdersNotListed) {
    Grating grating = slit(1500.0);
    grating.orders = {2};
    const double wavelength_nm = 512.0;
    const glm::dvec3 v = direction(0.0, 0.0);
    EXPECT_GT(brdf_energy(grating, direction(0.64, 0.0), v, wavelength_nm), 0.0);
    EXPECT_EQ(brdf_energy(grating, direction(0.32, 0.0), v, wavelength_nm), 0.0);
    glm::dvec3 below = direction(0.64, 0.0);
    below.z = -below.z;
    EXPECT_EQ(brdf_energy(grating, below, v, wavelength_nm), 0.0);
}

}  // namespace
}  // namespace rowland::diffraction
