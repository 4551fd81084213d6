#include "modules/diffraction/reference/reference.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/colour/observer.h"
#include "engine/core/parallel.h"
#include "engine/image/load.h"
#include "engine/math/quadrature.h"
#include "engine/math/sh_basis.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/grating_equation.h"
#include "tests/support/csv.h"
#include "tests/support/test_data.h"
#include "tests/unit/modules/diffraction/reference/oracle.h"

namespace rowland::diffraction {
namespace {

using test::OracleCase;
using test::relative_rms;

Grating compact_disc() {
    Grating grating;
    grating.pitch_nm = 1600.0;
    grating.profile = SlitProfile{800.0};
    return grating;
}

const Frame kFrame{.view = {0.3, 0.1, 0.9}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}};

lighting::ShLight uniform_light(const glm::dvec3& radiance) {
    // Y_00 = 1/(2√π).
    return {.bands = 1, .coefficients = {radiance * 2.0 * std::sqrt(std::numbers::pi)}};
}

/// PHYSICS §9: 1e-4 relative RMS, every grating by itself.
TEST(Reference, MatchesTheBandlimitedOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const std::vector<OracleCase> cases = test::read_cases(path);
    ASSERT_EQ(cases.size(), 5U);
    for (const OracleCase& one : cases) {
        const auto found = reference_radiance(one.grating, light, colour::LightSpectra(), one.frames);
        const double error = relative_rms(found, one.xyz);
        RecordProperty(one.name, fmt::format("{:.3g}", error));
        EXPECT_LT(error, 1e-4) << one.name;
    }
}

/// The gratings of radiance_bandlimited_asymmetric.csv, by the name of their row.
Grating asymmetric_grating(const std::string& name) {
    Grating grating;
    if (name == "agu") {
        grating = {.pitch_nm = 1600.0, .profile = SlitProfile{600.0}, .orders = {-2, 1}};
        grating.normalization = Normalization::Agu;
    } else if (name == "gold") {
        grating = {.pitch_nm = 1600.0, .profile = LamellarProfile{0.35, 130.0}, .orders = {1, 2}};
        grating.metal = colour::Metal::Au;
    } else {
        grating = {
            .pitch_nm = 1200.0, .profile = BlazedProfile{260.0}, .orders = {name == "blazed_minus_one" ? -1 : 1}};
    }
    return grating;
}

/// PHYSICS §9: 1e-4. A wrong sign of g, a lost metal or a lost λ/550 cannot pass.
TEST(Reference, MatchesTheAsymmetricOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited_asymmetric.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const rowland::test::Csv table = rowland::test::read_csv(path, ';');
    const auto frames = test::read_frames(table);
    const auto xyz = test::read_xyz(table);
    for (const std::string name : {"agu", "gold", "blazed_one_order", "blazed_minus_one"}) {
        std::vector<Frame> case_frames;
        std::vector<glm::dvec3> expected;
        for (std::size_t row = 0; row < frames.size(); ++row) {
            if (table.text(row, "case") != name) continue;
            case_frames.push_back(frames[row]);
            expected.push_back(xyz[row]);
        }
        ASSERT_EQ(expected.size(), 12U) << name;
        const auto found = reference_radiance(asymmetric_grating(name), light, colour::LightSpectra(), case_frames);
        const double error = relative_rms(found, expected);
        RecordProperty(name, fmt::format("{:.3g}", error));
        EXPECT_LT(error, 1e-4) << name;
    }
}

lighting::ProbeImage load_probe(const std::filesystem::path& path, lighting::Mapping mapping) {
    return {image::load_image(path), mapping, path.string()};
}

/// PHYSICS §9: 1 % on a real probe at full resolution.
TEST(Reference, MatchesGraceOnTheTiltedDisc) {
    ROWLAND_TEST_DATA(frames_path, "oracle/frames_tilted_cd.csv");
    ROWLAND_TEST_DATA(oracle_path, "oracle/radiance_tilted_cd_grace.csv");
    ROWLAND_TEST_DATA(probe_path, "probes/grace_probe.hdr");
    const auto probe = load_probe(probe_path, lighting::Mapping::Angular);
    const auto frames = test::read_frames(rowland::test::read_csv(frames_path));
    const auto found = reference_radiance(compact_disc(), probe, colour::LightSpectra(), frames);
    EXPECT_LT(relative_rms(found, test::read_xyz(rowland::test::read_csv(oracle_path))), 0.01);
}

/// PHYSICS §9: 0.5 %; the oracle's wavelengths are 2 nm apart.
TEST(Reference, MatchesVeniceSunset) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_venice_sunset_256.csv");
    ROWLAND_TEST_DATA(probe_path, "probes/venice_sunset_256.hdr");
    const auto probe = load_probe(probe_path, lighting::Mapping::Equirectangular);
    const std::vector<OracleCase> cases = test::read_cases(path);
    ASSERT_EQ(cases.size(), 5U);
    for (const OracleCase& one : cases) {
        const auto found = reference_radiance(one.grating, probe, colour::LightSpectra(), one.frames);
        const double error = relative_rms(found, one.xyz);
        RecordProperty(one.name, fmt::format("{:.3g}", error));
        EXPECT_LT(error, 0.005) << one.name;
    }
}

/// Under uniform light A(a) = L √(1−a²), so XYZ = Σ_m ∫ η_m cmf E L √(1−a²) dλ by hand. The integrand has a square-root
/// end where an order reaches the horizon, none here: rounding only.
TEST(Reference, UniformLightHasTheClosedForm) {
    Grating grating = compact_disc();
    grating.orders = {1};
    const glm::dvec3 rgb(0.5, 0.7, 0.2);
    const Frame frame{.view = {0.1, 0.3, 0.9}, .normal = {0, 0, 1}, .grating = {1, 0, 0}};
    const double v_g = glm::normalize(frame.view).x;
    const colour::LightSpectra spectra;
    glm::dvec3 expected(0.0);
    for (int wavelength_nm = 380; wavelength_nm <= 780; ++wavelength_nm) {
        const double a = wavelength_nm / 1600.0 - v_g;
        const double weight = (wavelength_nm == 380 || wavelength_nm == 780 ? 0.5 : 1.0) *
                              profile_efficiency(grating.profile, 1600.0, 1, wavelength_nm) * std::sqrt(1.0 - a * a);
        expected += weight * glm::dot(spectra(wavelength_nm), rgb) * colour::cie_xyz(wavelength_nm);
    }
    const auto found = reference_radiance(grating, uniform_light(rgb), spectra, std::span(&frame, 1));
    EXPECT_LT(relative_rms(found, {expected}), 1e-12);
}

TEST(Reference, ViewBelowTheHorizonIsBlack) {
    Frame below = kFrame;
    below.view.z = -0.2;
    const auto found = reference_radiance(compact_disc(), uniform_light(glm::dvec3(1.0)), colour::LightSpectra(),
                                          std::span(&below, 1));
    EXPECT_EQ(found[0], glm::dvec3(0.0));
}

TEST(Reference, SubwavelengthPitchIsExactlyBlack) {
    for (const double grooves : {1500.0, 10.0}) {
        Grating grating = compact_disc();
        grating.pitch_nm = 150.0;
        grating.profile = SlitProfile{75.0};
        grating.grooves = grooves;
        const auto found =
            reference_radiance(grating, uniform_light(glm::dvec3(1.0)), colour::LightSpectra(), std::span(&kFrame, 1));
        EXPECT_EQ(found[0], glm::dvec3(0.0)) << grooves;
    }
}

TEST(Reference, GrazingViewsStayFinite) {
    std::vector<Frame> frames;
    for (const double v_n : {1e-12, 1e-6, 0.01}) {
        frames.push_back({.view = {1.0, 0.0, v_n}, .normal = {0, 0, 1}, .grating = {1, 0, 0}});
        frames.push_back({.view = {0.0, 1.0, v_n}, .normal = {0, 0, 1}, .grating = {1, 0, 0}});
    }
    for (const GrooveLobe& lobe :
         {GrooveLobe{FlatLobe{}}, GrooveLobe{GaussianLobe{1e-3}}, GrooveLobe{GaussianLobe{1e3}}}) {
        Grating grating = compact_disc();
        grating.lobe = lobe;
        for (const glm::dvec3& xyz :
             reference_radiance(grating, uniform_light(glm::dvec3(1.0)), colour::LightSpectra(), frames)) {
            EXPECT_TRUE(std::isfinite(xyz.x + xyz.y + xyz.z));
            EXPECT_GE(xyz.y, 0.0);
        }
    }
}

TEST(Reference, DoesNotDependOnTheNumberOfThreads) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const OracleCase one = test::read_cases(path).front();
    const auto run = [&](unsigned threads) {
        const ThreadLimit limit(threads);
        return reference_radiance(one.grating, light, colour::LightSpectra(), one.frames);
    };
    EXPECT_EQ(run(1), run(2));
}

/// The slow twin for few grooves: ∫∫ f_E L s_n dω dλ with the pointwise BRDF, over s_g and s_h (s_n dω = ds_g ds_h), by
/// a midpoint rule in s_g fine enough for N = 7 and Gauss–Legendre along the arc.
glm::dvec3 brute_force(const Grating& grating, const lighting::ShLight& light, const colour::LightSpectra& spectra,
                       const glm::dvec3& v) {
    const math::QuadratureRule arc = math::gauss_legendre(24, 0.0, std::numbers::pi);
    std::vector<double> basis(light.coefficients.size());
    glm::dvec3 sum(0.0);
    const int nodes = 1600;
    for (int i = 0; i < nodes; ++i) {
        const double s_g = (i + 0.5) * 2.0 / nodes - 1.0;
        const double r = std::sqrt(1.0 - s_g * s_g);
        for (std::size_t j = 0; j < arc.nodes.size(); ++j) {
            const glm::dvec3 s(s_g, r * std::cos(arc.nodes[j]), r * std::sin(arc.nodes[j]));
            math::evaluate_sh(s, light.bands, basis);
            glm::dvec3 radiance(0.0);
            for (std::size_t k = 0; k < basis.size(); ++k) radiance += basis[k] * light.coefficients[k];
            const double area = 2.0 / nodes * arc.weights[j] * s.z;
            for (int wavelength_nm = 380; wavelength_nm <= 780; wavelength_nm += 2) {
                const double step_nm = wavelength_nm == 380 || wavelength_nm == 780 ? 1.0 : 2.0;
                sum += step_nm * area * brdf_energy(grating, s, v, wavelength_nm) *
                       glm::dot(spectra(wavelength_nm), radiance) * colour::cie_xyz(wavelength_nm);
            }
        }
    }
    return sum;
}

/// Tolerance: 2 nm against 1 nm wavelengths, and steps at the borders of the listed orders' periods; 1e-3 covers both.
TEST(Reference, FewGroovesHaveTheirTrueWidth) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    Grating grating = compact_disc();
    grating.orders = {-1, 1, 2};
    for (const double grooves : {1.0, 7.0}) {
        grating.grooves = grooves;
        const glm::dvec3 v = glm::normalize(kFrame.view);
        const auto found = reference_radiance(grating, light, colour::LightSpectra(), std::span(&kFrame, 1));
        EXPECT_LT(relative_rms(found, {brute_force(grating, light, colour::LightSpectra(), v)}), 1e-3) << grooves;
    }
}

/// Just below the border the width of an order is λ/49: the result is near N → ∞ (a few per cent lie in sidelobes that
/// leave the listed periods or meet other light).
TEST(Reference, FortyNineGroovesAreNearInfinitelyMany) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    Grating grating = compact_disc();
    const auto many = reference_radiance(grating, light, colour::LightSpectra(), std::span(&kFrame, 1));
    grating.grooves = 49.0;
    const auto few = reference_radiance(grating, light, colour::LightSpectra(), std::span(&kFrame, 1));
    EXPECT_LT(relative_rms(few, many), 0.05);
    EXPECT_GT(relative_rms(few, many), 1e-6);
}

}  // namespace
}  // namespace rowland::diffraction
