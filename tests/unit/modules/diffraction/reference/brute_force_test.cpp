#include "tests/unit/modules/diffraction/reference/brute_force.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/bake/arc_moments.h"
#include "modules/diffraction/reference/reference.h"
#include "tests/support/files.h"
#include "tests/unit/modules/diffraction/gratings.h"
#include "tests/unit/modules/diffraction/reference/oracle.h"

namespace rowland::diffraction {
namespace {

using test::compact_disc;

const glm::dvec3 kView = glm::normalize(glm::dvec3(0.3, 0.2, 0.9));

/// c_i = Σ_m ∫ η_m C_i(mλ/d − v_g) cmf Eᵀ dλ (PHYSICS §5). A tenth of a nanometre a step: sampling knows nothing of
/// the 1 nm rule.
std::vector<glm::dmat3> closed_form(const Grating& grating, const colour::LightSpectra& spectra, int bands) {
    const ArcCoefficients arcs(bands, grating.lobe);
    const auto count = static_cast<std::size_t>(bands * bands);
    std::vector<glm::dmat3> result(count, glm::dmat3(0.0));
    std::vector<double> arc_frame(count);
    std::vector<double> c(count);
    constexpr int kSteps = 4000;
    for (const int order : grating.orders)
        for (int i = 0; i <= kSteps; ++i) {
            const double wavelength_nm = 380.0 + 0.1 * i;
            std::fill(arc_frame.begin(), arc_frame.end(), 0.0);
            arcs.accumulate(order * wavelength_nm / grating.pitch_nm - kView.x, kView.y, wavelength_nm,
                            0.1 * (i == 0 || i == kSteps ? 0.5 : 1.0) * order_efficiency(grating, order, wavelength_nm),
                            arc_frame);
            arcs.to_tangent_frame(arc_frame, c);
            const glm::dmat3 observed = glm::outerProduct(colour::cie_xyz(wavelength_nm), spectra(wavelength_nm));
            for (std::size_t k = 0; k < count; ++k) result[k] += c[k] * observed;
        }
    return result;
}

double squared(const glm::dmat3& m) {
    return glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]);
}

double relative_rms(const std::vector<glm::dmat3>& found, const std::vector<glm::dmat3>& expected) {
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        difference += squared(found[i] - expected[i]);
        size += squared(expected[i]);
    }
    return std::sqrt(difference / size);
}

struct Convergence {
    double slope = 0.0;  ///< of log error over log samples, least squares
    double last_error = 0.0;
};

/// Root mean square over seeds of the coefficients' error at 1e3 … 1e6 samples.
Convergence convergence(const Grating& grating) {
    const colour::LightSpectra spectra;
    const std::vector<glm::dmat3> expected = closed_form(grating, spectra, 5);
    std::vector<glm::dvec2> points;
    for (const std::size_t samples : {1000U, 10000U, 100000U, 1000000U}) {
        double sum = 0.0;
        constexpr int kSeeds = 4;
        for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
            const double error = relative_rms(
                brute_force_coefficients(grating, spectra, kView, {.bands = 5, .samples = samples, .seed = seed}),
                expected);
            sum += error * error / kSeeds;
        }
        points.emplace_back(std::log(static_cast<double>(samples)), 0.5 * std::log(sum));
    }
    glm::dvec2 mean(0.0);
    for (const glm::dvec2& p : points) mean += p / 4.0;
    double covariance = 0.0;
    double variance = 0.0;
    for (const glm::dvec2& p : points) {
        covariance += (p.x - mean.x) * (p.y - mean.y);
        variance += (p.x - mean.x) * (p.x - mean.x);
    }
    return {covariance / variance, std::exp(points.back().y)};
}

/// At least as 1/√samples. Jitter in two dimensions of an integrand that is smooth but for the ends of the range gives
/// −¾ and better (measured −0.76 … −0.81); a mistake of a factor would stop the fall, slope 0. The closed form itself
/// is good to 1e-6.
TEST(BruteForce, ConvergesToTheClosedForm) {
    Grating gaussian = compact_disc();
    gaussian.lobe = GaussianLobe{0.2};
    Grating blazed = compact_disc();
    blazed.profile = BlazedProfile{260.0};
    blazed.orders = {-1, 1, 3};
    blazed.metal = colour::Metal::Au;
    Grating agu = compact_disc();
    agu.normalization = Normalization::Agu;
    const std::pair<const char*, Grating> cases[] = {
        {"slit", compact_disc()}, {"gaussian", gaussian}, {"blazed_gold", blazed}, {"agu", agu}};
    for (const auto& [name, grating] : cases) {
        const Convergence found = convergence(grating);
        EXPECT_LT(found.slope, -0.5) << name;
        EXPECT_LT(found.last_error, 0.0035) << name;  // measured 0.0012 … 0.0018
    }
}

/// Under light, against the reference, which knows nothing of harmonics' coefficients: 1 nm steps, 2e-3 of sampling.
TEST(BruteForce, UnderBandlimitedLightIsTheReference) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const colour::LightSpectra spectra;
    const Grating grating = compact_disc();
    // World axes are the tangent frame's: n is z, g is x.
    const ShadingPoint frame{.view = kView, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}};
    const glm::dvec3 expected = reference_radiance(grating, light, spectra, std::span(&frame, 1)).front();
    const glm::dvec3 found = brute_force_radiance(
        brute_force_coefficients(grating, spectra, kView, {.bands = 5, .samples = 200000, .seed = 7}), light);
    EXPECT_LT(glm::length(found - expected) / glm::length(expected), 2e-3);
}

TEST(BruteForce, DependsOnTheSeedAndNotOnTheThreads) {
    const auto run = [](unsigned threads, std::uint64_t seed) {
        const ThreadLimit limit(threads);
        return brute_force_coefficients(compact_disc(), colour::LightSpectra(), kView,
                                        {.bands = 3, .samples = 5000, .seed = seed});
    };
    EXPECT_EQ(run(1, 1), run(2, 1));
    EXPECT_NE(run(1, 1), run(1, 2));
}

TEST(BruteForce, WhatNoLightReachesIsZero) {
    Grating fine = compact_disc();
    fine.pitch_nm = 180.0;
    for (const glm::dmat3& c : brute_force_coefficients(fine, colour::LightSpectra(), kView, {.samples = 5000}))
        EXPECT_EQ(c, glm::dmat3(0.0));
    for (const glm::dmat3& c :
         brute_force_coefficients(compact_disc(), colour::LightSpectra(), {0.6, 0.0, -0.8}, {.samples = 5000}))
        EXPECT_EQ(c, glm::dmat3(0.0));
}

TEST(BruteForce, FewGroovesAreRefused) {
    Grating few = compact_disc();
    few.grooves = 20.0;
    EXPECT_THROW(brute_force_coefficients(few, colour::LightSpectra(), kView, {}), Error);
}

TEST(Reference, UnderSodiumIsSodiumYellowOrBlack) {
    const colour::LightSpectra sodium(
        colour::parse_illuminant("wavelength_nm,relative_power\n588,0\n589,1\n590,0\n", "sodium"));
    lighting::ShLight light{5, std::vector<glm::dvec3>(25, glm::dvec3(0.0))};
    for (int l = 0; l < 5; ++l) light.coefficients[static_cast<std::size_t>(l * (l + 1))] = glm::dvec3(1.0, 0.9, 0.8);
    Grating first = compact_disc();
    first.pitch_nm = 400.0;
    first.profile = SlitProfile{200.0};
    first.orders = {1};
    const glm::dvec3 line = colour::cie_xyz(589.0);
    for (int i = 0; i < 40; ++i) {
        const double v_g = -0.975 + 0.05 * i;
        const ShadingPoint frame{
            .view = {v_g, 0.0, std::sqrt(1.0 - v_g * v_g)}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}};
        const glm::dvec3 disc = reference_radiance(compact_disc(), light, sodium, std::span(&frame, 1)).front();
        ASSERT_NE(disc, glm::dvec3(0.0));
        EXPECT_NEAR(disc.x / (disc.x + disc.y + disc.z), line.x / (line.x + line.y + line.z), 1e-3) << v_g;
        EXPECT_NEAR(disc.y / (disc.x + disc.y + disc.z), line.y / (line.x + line.y + line.z), 1e-3) << v_g;
        const glm::dvec3 dark = reference_radiance(first, light, sodium, std::span(&frame, 1)).front();
        if (v_g < 0.47) {
            EXPECT_EQ(dark, glm::dvec3(0.0)) << v_g;
        } else if (v_g > 0.5) {
            EXPECT_NE(dark, glm::dvec3(0.0)) << v_g;
        }
    }
}

}  // namespace
}  // namespace rowland::diffraction
