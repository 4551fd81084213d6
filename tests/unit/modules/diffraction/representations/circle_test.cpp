#include <glm/geometric.hpp>
#include <numbers>

#include "engine/lighting/environment_map.h"
#include "modules/diffraction/representations/circle/circle.h"
#include "modules/diffraction/representations/circle/circle_map.h"
#include "modules/diffraction/representations/planar/planar_map.h"
#include "tests/support/threads.h"
#include "tests/unit/modules/diffraction/representations/probe_maps.h"

namespace rowland::diffraction {
namespace {

using test::relative_rms;

/// Broad light: a few lobes and a little all around, as texels.
lighting::LightSamples broad_light() {
    image::Image image{.width = 256, .height = 128, .texels = {}};
    image.texels.resize(std::size_t{256} * 128, glm::vec3(0.1F));
    const lighting::ProbeImage grid(image, lighting::Mapping::Equirectangular);
    const lighting::KeyLight lobes[] = {{glm::normalize(glm::dvec3(0.2, 0.9, 0.4)), {3.0, 2.0, 1.0}, 6.0},
                                        {glm::normalize(glm::dvec3(-0.7, 0.1, 0.7)), {0.5, 1.0, 2.0}, 8.0}};
    for (int row = 0; row < 128; ++row)
        for (int column = 0; column < 256; ++column)
            for (const lighting::KeyLight& lobe : lobes)
                image.at(column, row) +=
                    glm::vec3(lighting::lobe_density(lobe, grid.direction(column + 0.5, row + 0.5)) * lobe.flux);
    return lighting::light_samples(lighting::ProbeImage(std::move(image), lighting::Mapping::Equirectangular), {}, 1.0);
}

Grating blazed() {
    Grating grating;
    grating.pitch_nm = 1600.0;
    grating.profile = BlazedProfile{260.0};
    grating.orders = std::vector<int>{1};
    return grating;
}

/// Frames of planes of many normals, with the radiance that a planar map of each gives: exact in the cosine.
struct Planes {
    std::vector<ShadingPoint> frames;
    std::vector<glm::dvec3> xyz;
};
Planes planes(const lighting::LightSamples& texels, const Grating& grating) {
    Planes result;
    const KernelTable kernel = tabulate(ColourKernel(grating, colour::LightSpectra()));
    for (const glm::dvec3 n : {glm::dvec3(0, 0, 1), {0.3, 0.9, 0.1}, {-0.6, 0.4, -0.5}, {0.1, -0.3, 0.9}}) {
        const PlanarMap map =
            fill_planar_map(texels, kernel, grating.pitch_nm, n, {128, 128}, glm::dmat3(0.0), grating.cover);
        for (int i = 0; i < 12; ++i) {
            const double angle = 0.53 * i;
            const glm::dvec3 g = std::cos(angle) * map.e1 + std::sin(angle) * map.e2;
            result.frames.push_back({map.n + 0.9 * std::sin(2.0 * i) * g + 0.2 * glm::cross(map.n, g), n, g});
            result.xyz.push_back(sample(map, result.frames.back()));
        }
    }
    return result;
}

std::vector<glm::dvec3> sampled(const CircleMap& map, const std::vector<ShadingPoint>& frames) {
    std::vector<glm::dvec3> xyz;
    for (const ShadingPoint& frame : frames) xyz.push_back(sample(map, frame));
    return xyz;
}

/// The slow reference is a planar map for every normal. The tolerance covers the map's steps.
TEST(CircleMap, AgreesWithPlanarMapsOfAnyNormal) {
    const lighting::LightSamples texels = broad_light();
    for (const Grating& grating : {test::compact_disc(), blazed()}) {
        const Planes expected = planes(texels, grating);
        const KernelTable kernel = tabulate(ColourKernel(grating, colour::LightSpectra()));
        const CircleMap map = fill_circle_map(texels, kernel, grating.pitch_nm, {32, 64, 14});
        EXPECT_EQ(map.charts, grating.orders.size() == 1 ? 2 : 1);
        const double error = relative_rms(sampled(map, expected.frames), expected.xyz);
        EXPECT_LT(error, 0.02);
    }
}

/// In air the coefficients are those of PHYSICS (6.6), and under a cover the series converges sooner.
TEST(CircleMap, TheSeriesApproachesTheClampedCosine) {
    using std::numbers::pi;
    const auto in_air = clamped_cosine(std::nullopt, 0.5);
    for (std::size_t k = 2; k < in_air.size(); k += 2)
        EXPECT_NEAR(in_air[k], (k % 4 == 2 ? 2.0 : -2.0) / (pi * (static_cast<double>(k * k) - 1.0)), 1e-12);
    for (std::size_t k = 3; k < in_air.size(); k += 2) EXPECT_NEAR(in_air[k], 0.0, 1e-12);
    for (const double r : {0.05, 0.4, 1.0}) {
        const auto series = clamped_cosine(Cover{}, r);
        double error = 0.0;
        double size = 0.0;
        for (int i = 0; i < 2000; ++i) {
            const double t = pi * (i + 0.5) / 2000;
            const double exact = transmittance(Cover{}.ior, r * std::cos(t)) * std::max(0.0, std::cos(t));
            double sum = 0.0;
            for (std::size_t k = 0; k < series.size(); ++k) sum += series[k] * std::cos(static_cast<double>(k) * t);
            error += (sum - exact) * (sum - exact);
            size += exact * exact;
        }
        EXPECT_LT(std::sqrt(error / size), 0.011) << r;  // the terms above cos 12t: in air .0105
    }
}

/// Without the remainder the series ends at cos 2t; a cover's has odd multiples as well.
TEST(CircleMap, TheRestOfTheSeriesCountsInAirAndUnderACover) {
    const lighting::LightSamples texels = broad_light();
    Grating grating = blazed();
    for (const bool covered : {false, true}) {
        if (covered) grating.cover = Cover{};
        const Planes expected = planes(texels, grating);
        const KernelTable kernel = tabulate(ColourKernel(grating, colour::LightSpectra()));
        const auto error = [&](int angles) {
            const CircleMap map =
                fill_circle_map(texels, kernel, grating.pitch_nm, {32, 64, angles}, glm::dmat3(0.0), grating.cover);
            return relative_rms(sampled(map, expected.frames), expected.xyz);
        };
        const double with = error(circle_angles(grating.cover));
        const double without = error(0);
        EXPECT_LT(with, 0.02);
        EXPECT_GT(without, 1.5 * with);
    }
}

/// Frames with g at the equator, on either side of it, and reversed.
TEST(CircleMap, ChartsMeetWithoutASeam) {
    const lighting::LightSamples texels = broad_light();
    for (const Grating& grating : {test::compact_disc(), blazed()}) {
        const CircleMap map = fill_circle_map(texels, tabulate(ColourKernel(grating, colour::LightSpectra())),
                                              grating.pitch_nm, {32, 64, 14});
        std::vector<glm::dvec3> above;
        std::vector<glm::dvec3> below;
        for (int i = 0; i < 40; ++i) {
            const glm::dvec3 level(std::cos(0.157 * i), 0.0, std::sin(0.157 * i));
            const glm::dvec3 n = glm::normalize(glm::dvec3(-level.z, 0.7, level.x));
            const glm::dvec3 view = n + 0.6 * std::sin(1.3 * i) * level;
            above.push_back(sample(map, {view, n, level + glm::dvec3(0, 1e-6, 0)}));
            below.push_back(sample(map, {view, n, level - glm::dvec3(0, 1e-6, 0)}));
        }
        EXPECT_LT(relative_rms(above, below), 0.01) << map.charts;  // two charts' map errors
    }
}

TEST(CircleMap, ViewBelowTheHorizonIsBlack) {
    const CircleMap map = fill_circle_map(
        broad_light(), tabulate(ColourKernel(test::compact_disc(), colour::LightSpectra())), 1600.0, {8, 8, 14});
    EXPECT_EQ(sample(map, {{0.1, -0.5, 0.1}, {0, 1, 0}, {1, 0, 0}}), glm::dvec3(0.0));
    EXPECT_NE(sample(map, {{0.1, 0.5, 0.1}, {0, 1, 0}, {1, 0, 0}}), glm::dvec3(0.0));
}

/// The counts of circle.glsl.
TEST(CircleMap, CostsWhatItsShaderReadsAndComputes) {
    const ShadingCost series = cost(CircleTables{{.size = {.angles = 0}, .charts = 1}});
    EXPECT_EQ(series.fetches_per_pixel, 4);
    EXPECT_EQ(series.multiply_adds_per_pixel, 36);
    const ShadingCost with_rest = cost(CircleTables{{.size = {.angles = 14}, .charts = 1}});
    EXPECT_EQ(with_rest.fetches_per_pixel, 6);
    EXPECT_EQ(with_rest.multiply_adds_per_pixel, 64);
}

TEST(CircleMap, DoesNotDependOnTheThreads) {
    const lighting::LightSamples texels = broad_light();
    const KernelTable kernel = tabulate(ColourKernel(test::compact_disc(), colour::LightSpectra()));
    rowland::test::expect_same_on_any_threads([&] {
        const CircleMap map = fill_circle_map(texels, kernel, 1600.0, {8, 16, 14});
        return std::pair(map.terms.xyz, map.remainder.xyz);
    });
}

void matches_oracle(const test::OracleProbe& probe) {
    test::matches_oracle(probe, "sphere",
                         [](const lighting::LightSamples& texels, const KernelTable& kernel, const glm::dvec3&) {
                             return fill_circle_map(texels, kernel, 1600.0);
                         });
}

/// The default map and 16 key lights. The tolerances are about a sixth above the measured errors.
TEST(CircleMap, MatchesGrace) {
    matches_oracle({"grace", "grace_probe.hdr", lighting::Mapping::Angular, 0.0165});
}
TEST(CircleMap, MatchesEnnis) {
    matches_oracle({"ennis", "ennis_probulator.hdr", lighting::Mapping::Equirectangular, 0.02});
}
TEST(CircleMap, MatchesBlenderSunset) {
    matches_oracle({"blender_sunset", "blender_sunset.exr", lighting::Mapping::Equirectangular, 0.0012});
}
TEST(CircleMap, MatchesRoyalEsplanade) {
    matches_oracle({"royal_esplanade", "royal_esplanade_1k.hdr", lighting::Mapping::Equirectangular, 0.012});
}

glm::dvec3 flux_of(const ImageLight& light, std::size_t image) {
    glm::dvec3 flux;
    for (int c = 0; c < 3; ++c) flux[c] = light.flux[2 * static_cast<std::size_t>(c) + image / 4][image % 4];
    return flux;
}

TEST(CircleLight, LightOfAnyResolutionIsOneSampleForEachCell) {
    for (const int cells : {kCircleLightCells, 40}) {
        const auto side = static_cast<std::size_t>(cells) + 2;
        for (const int face_size : {128, 256})
            EXPECT_LE(circle_light(test::even_light(face_size), cells).size(), 6 * side * side);
    }
}

/// Each keeps its mean direction and spreads alike, wherever it lies among the cells: the map's filling relies on it. A
/// cell is up to a quarter smaller along an axis away from a face's middle.
TEST(CircleLight, LampsKeepTheirMeanDirectionAndSpreadAlike) {
    const double largest = circle_light_variance(kCircleLightCells);
    double sum = 0.0;
    constexpr int kLamps = 400;
    for (int i = 0; i < kLamps; ++i) {
        const double y = 2.0 * (i + 0.5) / kLamps - 1.0;
        const double r = std::sqrt(1.0 - y * y);
        const glm::dvec3 lamp(r * std::cos(2.4 * i), y, r * std::sin(2.4 * i));
        lighting::LightSamples light;
        light.push_back(lamp, glm::dvec3(1.0));
        glm::dvec3 mean(0.0);
        double spread = 0.0;
        for (const ImageLight& cell : circle_light(light)) {
            const glm::dvec3 s(cell.direction);
            mean += flux_of(cell, 0).x * s;
            spread += flux_of(cell, 0).x * glm::dot(s - lamp, s - lamp);
        }
        EXPECT_LT(glm::distance(glm::normalize(mean), lamp), 2e-4) << i;
        EXPECT_LT(spread, 3.2 * largest) << i;  // a tent between two cells: up to ¼ h² = 1.5 times its mean, h²/6
        sum += spread / kLamps;
    }
    EXPECT_NEAR(sum, 2.0 * largest, 0.4 * largest);
}

/// The residual of a probe less its key lights is negative in places.
TEST(CircleLight, NegativeFluxIsKept) {
    lighting::LightSamples light = test::even_light(256);
    light.push_back(glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(-3.0));
    glm::dvec3 sum(0.0);
    glm::dvec3 of_cells(0.0);
    for (std::size_t i = 0; i < light.size(); ++i) sum += light.flux(i);
    for (const ImageLight& cell : circle_light(light)) of_cells += flux_of(cell, 0);
    EXPECT_LT(glm::distance(of_cells, sum), 1e-4);
}

/// Each direction holds what comes from its images, which are directions themselves.
TEST(CircleLight, ImagesAreTheLightFromTurnedDirections) {
    lighting::LightSamples light;
    light.push_back(glm::normalize(glm::dvec3(0.3, 0.5, -0.8)), glm::dvec3(1.0, 2.0, 4.0));
    light.push_back(glm::normalize(glm::dvec3(-0.9, 0.1, 0.2)), glm::dvec3(3.0, 2.0, 1.0));
    const std::vector<ImageLight> cells = circle_light(light);
    const auto key_of = [](const glm::dvec3& s) {
        return std::array{std::lround(1e4 * s.x), std::lround(1e4 * s.y), std::lround(1e4 * s.z)};
    };
    std::map<std::array<long, 3>, glm::dvec3> by_direction;
    for (const ImageLight& cell : cells) by_direction[key_of(cell.direction)] = flux_of(cell, 0);
    EXPECT_EQ(by_direction.size(), cells.size());
    for (const ImageLight& cell : cells)
        for (std::size_t image = 0; image < kCircleImages; ++image)
            EXPECT_EQ(flux_of(cell, image), by_direction[key_of(circle_image(cell.direction, image))]) << image;
}

}  // namespace
}  // namespace rowland::diffraction
