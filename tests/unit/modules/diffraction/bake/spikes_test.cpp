#include "modules/diffraction/bake/spikes.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/colour/observer.h"
#include "engine/core/error.h"
#include "engine/math/sh_rotation.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/model/grating_equation.h"
#include "tests/support/test_data.h"
#include "tests/unit/modules/diffraction/reference/oracle.h"

namespace rowland::diffraction {
namespace {

using test::OracleCase;

Grating compact_disc() {
    Grating grating;
    grating.pitch_nm = 1600.0;
    grating.profile = SlitProfile{800.0};
    return grating;
}

SpikeSettings settings(int spikes, int bands = 5) {
    SpikeSettings result;
    result.spikes = spikes;
    result.bands = bands;
    return result;
}

lighting::ShLight rotated(const lighting::ShLight& light, const glm::dmat3& tangent) {
    lighting::ShLight result{light.bands, std::vector<glm::dvec3>(light.coefficients.size())};
    math::ShRotation(tangent, light.bands)
        .apply(std::span<const glm::dvec3>(light.coefficients), std::span<glm::dvec3>(result.coefficients));
    return result;
}

/// PHYSICS §6: largest component error over largest component.
double largest_error(const OracleCase& one, const lighting::ShLight& light, int spikes) {
    const SpikeBaker baker(one.grating, settings(spikes));
    double error = 0.0;
    double scale = 0.0;
    for (std::size_t i = 0; i < one.frames.size(); ++i) {
        const glm::dmat3 tangent = world_to_tangent(one.frames[i]);
        const glm::dvec3 v = tangent * glm::normalize(one.frames[i].view);
        const glm::dvec3 xyz = evaluate_spikes(baker.bake(v.x, v.y), rotated(light, tangent), colour::LightSpectra());
        for (int c = 0; c < 3; ++c) {
            error = std::max(error, std::abs(xyz[c] - one.xyz[i][c]));
            scale = std::max(scale, std::abs(one.xyz[i][c]));
        }
    }
    return error / scale;
}

/// What the method gives with these rules is 9.5 / 0.3 / 0.03 % (PHYSICS §6, measured independently); held to 12 / 1 /
/// 0.1.
TEST(Spikes, ConvergeToTheBandlimitedOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    for (const OracleCase& one : test::read_cases(path)) {
        const double errors[] = {largest_error(one, light, 4), largest_error(one, light, 16),
                                 largest_error(one, light, 64)};
        RecordProperty(one.name, fmt::format("K=4 {:.4g} K=16 {:.4g} K=64 {:.4g}", errors[0], errors[1], errors[2]));
        if (!one.name.starts_with("slit")) continue;
        EXPECT_LT(errors[0], 0.12) << one.name;
        EXPECT_LT(errors[1], 0.01) << one.name;
        EXPECT_LT(errors[2], 0.001) << one.name;
    }
}

/// The intervals share out ∫ c q exactly: Σ_k c_k,i q(λ_k) = ∫ c_i q dλ, whatever K.
TEST(Spikes, KeepTheIntegralOfEveryCoefficient) {
    const Grating grating = compact_disc();
    const ViewSpectrum spectrum(grating, 5);
    const auto q = [](double wavelength_nm) {
        const glm::dvec3 cmf = colour::cie_xyz(wavelength_nm);
        return colour::d65().power(wavelength_nm) * (cmf.x + cmf.y + cmf.z);
    };
    const std::vector<double> c = spectrum.coefficients(0.4, 0.1);
    for (const int count : {1, 4, 7, 64}) {
        const SpikeSet spikes = bake_spikes(grating, 0.4, 0.1, settings(count));
        ASSERT_EQ(spikes.wavelengths_nm.size(), static_cast<std::size_t>(count));
        for (std::size_t i = 0; i < 25; ++i) {
            double integral = 0.0;
            for (std::size_t j = 0; j < kWavelengths; ++j)
                integral +=
                    (j == 0 || j + 1 == kWavelengths ? 0.5 : 1.0) * c[j * 25 + i] * q(380.0 + static_cast<double>(j));
            double sum = 0.0;
            for (std::size_t k = 0; k < spikes.wavelengths_nm.size(); ++k)
                sum += spikes.coefficients[k * 25 + i] * q(spikes.wavelengths_nm[k]);
            EXPECT_NEAR(sum, integral, 1e-10) << "K " << count << " i " << i;  // ∫ q is 2e4, rounding 1e-12 of it
        }
    }
}

TEST(Spikes, WavelengthsAscendWithinTheVisibleRange) {
    for (const double v_g : {-0.99, -0.3, 0.0, 0.5, 1.0}) {
        const SpikeSet spikes = bake_spikes(compact_disc(), v_g, 0.0, settings(64));
        EXPECT_TRUE(std::is_sorted(spikes.wavelengths_nm.begin(), spikes.wavelengths_nm.end()));
        EXPECT_GE(spikes.wavelengths_nm.front(), 380.0);
        EXPECT_LE(spikes.wavelengths_nm.back(), 780.0);
    }
}

/// A step of 1e-9 in v_g moves arcs by as much; their ends turn with the square root, 3e-5. A wavelength that jumped
/// between whole nanometres would move by 1.
TEST(Spikes, AreContinuousInTheView) {
    for (const double v_g : {0.0, 0.1234, 0.5125, 0.7625}) {
        const SpikeSet here = bake_spikes(compact_disc(), v_g, 0.0, settings(4));
        const SpikeSet there = bake_spikes(compact_disc(), v_g + 1e-9, 0.0, settings(4));
        const double scale = std::abs(*std::max_element(here.coefficients.begin(), here.coefficients.end()));
        for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(here.wavelengths_nm[k], there.wavelengths_nm[k], 1e-3) << v_g;
        for (std::size_t i = 0; i < here.coefficients.size(); ++i)
            EXPECT_NEAR(here.coefficients[i], there.coefficients[i], 1e-4 * scale) << v_g;
    }
}

TEST(Spikes, ViewWithoutVisibleOrdersIsZeroWithFiniteWavelengths) {
    Grating blu_ray = compact_disc();
    blu_ray.pitch_nm = 320.0;
    blu_ray.profile = SlitProfile{160.0};
    blu_ray.orders = {-1, 1};
    const SpikeSet nothing = bake_spikes(blu_ray, 0.0, 0.0, settings(4));
    for (const double c : nothing.coefficients) EXPECT_EQ(c, 0.0);
    for (const double wavelength_nm : nothing.wavelengths_nm) EXPECT_TRUE(std::isfinite(wavelength_nm));
    // Where order 1 first shows violet (380/320 − v_g = 1), wavelengths come from there without a jump.
    const double edge = 380.0 / 320.0 - 1.0;
    const SpikeSet before = bake_spikes(blu_ray, edge - 1e-12, 0.0, settings(4));
    const SpikeSet after = bake_spikes(blu_ray, edge + 1e-12, 0.0, settings(4));
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(before.wavelengths_nm[k], after.wavelengths_nm[k], 2.0);
}

TEST(Spikes, NoOrdersAtAllIsBlack) {
    Grating fine = compact_disc();
    fine.pitch_nm = 150.0;
    fine.orders = all_orders(fine.pitch_nm);
    const SpikeSet spikes = bake_spikes(fine, 0.7, 0.0, settings(4));
    for (const double c : spikes.coefficients) EXPECT_EQ(c, 0.0);
    for (const double wavelength_nm : spikes.wavelengths_nm) EXPECT_TRUE(std::isfinite(wavelength_nm));
}

/// Lines of a lamp: a spike must not land in the dark between them, where its coefficient would be divided by nothing.
TEST(Spikes, FollowALampOfTwoLines) {
    SpikeSettings two_lines = settings(3);
    two_lines.illuminant = colour::parse_illuminant(
        "wavelength_nm,relative_power\n449,0\n450,1\n451,0\n649,0\n650,1\n651,0\n", "two lines");
    const SpikeSet spikes = bake_spikes(compact_disc(), 0.2, 0.0, two_lines);
    for (const double wavelength_nm : spikes.wavelengths_nm) EXPECT_GT(two_lines.illuminant.power(wavelength_nm), 0.0);
    for (const double c : spikes.coefficients) EXPECT_LT(std::abs(c), 100.0);
}

TEST(Spikes, FewGroovesAreRefused) {
    Grating few = compact_disc();
    few.grooves = 20.0;
    EXPECT_THROW(bake_spikes(few, 0.0, 0.0, settings(4)), Error);
}

/// Uniform light sees Y_00 alone: more bands of it change nothing.
TEST(Spikes, LightWithFewerBandsThanTheMaterialIsTheSameLight) {
    const SpikeSet spikes = bake_spikes(compact_disc(), 0.3, 0.0, settings(4));
    lighting::ShLight narrow{1, {glm::dvec3(1.0, 2.0, 3.0)}};
    lighting::ShLight wide{5, std::vector<glm::dvec3>(25, glm::dvec3(0.0))};
    wide.coefficients[0] = narrow.coefficients[0];
    const colour::LightSpectra spectra;
    EXPECT_EQ(evaluate_spikes(spikes, narrow, spectra), evaluate_spikes(spikes, wide, spectra));
}

}  // namespace
}  // namespace rowland::diffraction
