#include "modules/diffraction/representations/planar/lobe_map.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/parallel.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/representations/evaluation_light.h"
#include "tests/support/csv.h"
#include "tests/support/test_data.h"
#include "tests/unit/modules/diffraction/representations/probe_maps.h"

namespace rowland::diffraction {
namespace {

using test::relative_rms;

LobeMap lobe_map(const Grating& grating, const lighting::LightSamples& texels, const glm::dvec3& normal,
                 const LobeMapSize& size) {
    const LobeSpectrum spectrum(diffraction_pattern(grating, colour::LightSpectra()), size.views);
    return fill_lobe_map(texels, spectrum, normal, size.azimuths);
}

std::vector<glm::dvec3> samples(const LobeMap& map, const std::vector<ShadingPoint>& frames) {
    std::vector<glm::dvec3> xyz;
    for (const ShadingPoint& frame : frames) xyz.push_back(sample(map, frame));
    return xyz;
}

/// Points of a plane, seen from everywhere above it.
std::vector<ShadingPoint> points_of(const glm::dvec3& normal) {
    const PlaneAxes axes = plane_axes(normal);
    std::vector<ShadingPoint> points;
    for (int i = 0; i < 20; ++i) {
        const double azimuth = 2.4 * i;
        const double tilt = 0.03 + 0.075 * i;
        const glm::dvec3 across = std::cos(1.1 * i) * axes.e1 + std::sin(1.1 * i) * axes.e2;
        points.push_back({.view = std::cos(tilt) * axes.n + std::sin(tilt) * across,
                          .normal = axes.n,
                          .grating = std::cos(azimuth) * axes.e1 + std::sin(azimuth) * axes.e2});
    }
    return points;
}

lighting::ShLight smooth_light() {
    return {.bands = 3,
            .coefficients = {{4.0, 3.5, 3.0},
                             {0.5, -0.3, 0.2},
                             {1.2, 0.8, 0.9},
                             {-0.4, 0.6, 0.5},
                             {0.3, 0.1, -0.2},
                             {-0.2, 0.3, 0.4},
                             {0.2, 0.2, -0.3},
                             {0.1, -0.4, 0.2},
                             {0.4, 0.3, 0.1}}};
}

Grating with_lobe(const GrooveLobe& lobe) {
    Grating grating = test::compact_disc();
    grating.lobe = lobe;
    return grating;
}

/// The slow sum is the reference's quadrature. Light without detail: the rest is the map's steps of .03 at the
/// horizon's edge, .8 % for the lobe that is narrower than they are (measured), .5 % and less for the others.
TEST(LobeMap, EqualsTheReferenceUnderSmoothLight) {
    Grating blazed = with_lobe(GaussianLobe{0.1});
    blazed.profile = BlazedProfile{.depth_nm = 280.0};
    blazed.orders = {0, 1, 2};
    Grating long_pits = with_lobe(PitsLobe{.length_nm = 3000.0, .coherent = 0.5});
    long_pits.pitch_nm = 740.0;
    const lighting::ShLight light = smooth_light();
    const lighting::LightSamples texels = EvaluationLight(light, math::SphericalWindow::None).texels();
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
    const std::vector<ShadingPoint> points = points_of(normal);
    const struct {
        const char* name;
        Grating grating;
    } cases[] = {{"sigma 1", with_lobe(GaussianLobe{1.0})},
                 {"sigma 0.2", with_lobe(GaussianLobe{0.2})},
                 {"sigma 0.02", with_lobe(GaussianLobe{0.02})},
                 {"pits", with_lobe(PitsLobe{})},
                 {"incoherent pits", with_lobe(PitsLobe{.coherent = 0.0})},
                 {"long pits, fine pitch", long_pits},
                 {"blazed", blazed}};
    for (const auto& one : cases) {
        const LobeMap map = lobe_map(one.grating, texels, normal, {.azimuths = 32, .views = {.g = 64, .h = 64}});
        EXPECT_EQ(map.half_turn, std::string(one.name) != "blazed");
        const double error =
            relative_rms(samples(map, points), reference_radiance(one.grating, light, colour::LightSpectra(), points));
        RecordProperty(one.name, fmt::format("{:.3g}", error));
        EXPECT_LT(error, 1e-2) << one.name;
    }
}

/// The narrowest lobe under a doorway of a few texels: .9 % measured, 2 % is the goal. The coarse map, which is shown
/// for as long as an object turns: 10 % measured.
TEST(LobeMap, MatchesEnnisThroughANarrowLobe) {
    ROWLAND_TEST_DATA(frames_path, "oracle/frames_tilted_cd.csv");
    ROWLAND_TEST_DATA(probe_path, "probes/ennis_probulator.hdr");
    const auto frames = test::read_frames(rowland::test::read_csv(frames_path));
    const lighting::ProbeImage probe(image::load_image(probe_path), lighting::Mapping::Equirectangular);
    const Grating grating = with_lobe(GaussianLobe{0.02});
    const auto expected = reference_radiance(grating, IncidentLight(probe), colour::LightSpectra(), frames);
    const lighting::LightSamples texels = lighting::light_samples(probe);
    const auto error = [&](const LobeMapSize& size) {
        const double found = relative_rms(samples(lobe_map(grating, texels, frames[0].normal, size), frames), expected);
        RecordProperty(fmt::format("views_{}", size.views.g), fmt::format("{:.3g}", found));
        return found;
    };
    EXPECT_LT(error({}), 0.02);
    EXPECT_LT(error(kCoarseLobeMap), 0.15);
}

/// What is computed for the half turn alone is what the whole turn gives.
TEST(LobeMap, TheHalfTurnIsTheWholeTurn) {
    const lighting::LightSamples texels = EvaluationLight(smooth_light(), math::SphericalWindow::None).texels();
    DiffractionPattern pattern = diffraction_pattern(with_lobe(PitsLobe{}), colour::LightSpectra());
    ASSERT_TRUE(pattern.even);
    const glm::dvec3 normal(0, 0, 1);
    const LobeMapViews views{.g = 16, .h = 24};
    const LobeMap half = fill_lobe_map(texels, LobeSpectrum(pattern, views), normal, 16);
    pattern.even = false;
    const LobeMap whole = fill_lobe_map(texels, LobeSpectrum(pattern, views), normal, 16);
    EXPECT_EQ(half.values.size(), 9U * 16U * 24U);
    EXPECT_EQ(whole.values.size(), 16U * 16U * 24U);
    const std::vector<ShadingPoint> points = points_of(normal);
    EXPECT_LT(relative_rms(samples(half, points), samples(whole, points)), 1e-5);
}

TEST(LobeMap, AnyNumberOfThreadsGivesTheSameMap) {
    const lighting::LightSamples texels = EvaluationLight(smooth_light(), math::SphericalWindow::None).texels();
    const auto filled = [&](unsigned threads) {
        const ThreadLimit limit(threads);
        return lobe_map(with_lobe(PitsLobe{}), texels, {0, 1, 0}, {.azimuths = 16, .views = {.g = 16, .h = 16}});
    };
    EXPECT_EQ(filled(1).values, filled(2).values);
}

TEST(LobeMap, AViewBelowTheHorizonIsBlack) {
    const LobeMap map =
        lobe_map(with_lobe(GaussianLobe{0.2}), EvaluationLight(smooth_light(), math::SphericalWindow::None).texels(),
                 {0, 0, 1}, {.azimuths = 8, .views = {.g = 8, .h = 8}});
    EXPECT_EQ(sample(map, {.view = {0.1, 0.2, -0.3}, .normal = {0, 0, 1}, .grating = {1, 0, 0}}), glm::dvec3(0.0));
}

}  // namespace
}  // namespace rowland::diffraction
