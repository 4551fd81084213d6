// Small lights on lattices, in one look-up each.
#include "modules/diffraction/representations/direct/pattern_light.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <utility>

#include "modules/diffraction/reference/reference.h"
#include "tests/unit/modules/diffraction/reference/oracle.h"

namespace rowland::diffraction {
namespace {

const ShadingPoint kPlane{.view = {0, 0, 1}, .normal = {0, 0, 1}, .grating = {1, 0, 0}};

Grating lit_foil() {
    Grating grating;
    grating.orders.clear();
    grating.pitch_nm = 1000.0;
    grating.lattice =
        Lattice{.a_nm = {1000.0, 100.0},
                .b_nm = {-200.0, 1200.0},
                .profile = CrossedProfile{.along_a = BlazedProfile{200.0}, .along_b = BlazedProfile{150.0}},
                .orders = 2};
    return grating;
}

Grating lit_screen() {
    Grating grating;
    grating.orders.clear();
    grating.pitch_nm = 50000.0;
    grating.lattice = Lattice{.a_nm = {50000.0, 0.0},
                              .b_nm = {0.0, 50000.0},
                              .profile = ApertureProfile{.width_nm = 15000.0, .height_nm = 40000.0},
                              .orders = 4};
    return grating;
}

/// What the reference integrates in steps of `step`.
IncidentLight light_of(std::function<glm::dvec3(const glm::dvec3&)> radiance, double step) {
    static const lighting::ShLight kNone{.bands = 1, .coefficients = {glm::dvec3(0.0)}};
    IncidentLight light(kNone);
    light.radiance = std::move(radiance);
    light.panel_angle = step;
    return light;
}

/// Every level of the picture has all light of the pattern.
TEST(PatternPicture, EachLevelHoldsTheSameLight) {
    for (const Grating& grating : {lit_foil(), lit_screen()}) {
        const PatternPicture picture = pattern_picture(grating, colour::LightSpectra(), 256);
        glm::dmat3 whole(0.0);
        for (const DiffractionPattern::Node& node : diffraction_pattern(grating, colour::LightSpectra()).nodes)
            whole += glm::dmat3(node.weight);
        ASSERT_EQ(picture.levels.size(), 6U);
        for (const PatternPicture::Level& level : picture.levels) {
            const double texel = 2.0 * picture.half_width / level.size;
            glm::dmat3 sum(0.0);
            for (const glm::mat3& density : level.density) sum += texel * texel * glm::dmat3(density);
            for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(sum[c] - whole[c]), 0.02 * glm::length(whole[c]));
        }
    }
}

/// A grid of views around the mirror's direction, of the pattern's width: those above the horizon.
std::vector<ShadingPoint> views_around(const glm::dvec3& light, double half_width, int side) {
    std::vector<ShadingPoint> frames;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            const glm::dvec2 u = (2.0 * glm::dvec2(i + 0.5, j + 0.5) / double(side) - 1.0) * half_width;
            const glm::dvec2 v = u - glm::dvec2(light);
            if (glm::dot(v, v) >= 1.0) continue;
            ShadingPoint frame = kPlane;
            frame.view = {v.x, v.y, std::sqrt(1.0 - glm::dot(v, v))};
            frames.push_back(frame);
        }
    return frames;
}

const glm::dvec3 kToward = glm::normalize(glm::dvec3(0.2, -0.1, 1.0));
const glm::dvec3 kFlux(1.0, 0.8, 0.6);

struct LitLattice {
    const char* name;
    Grating grating;
    double deviation;   ///< of the light, in radians
    double half_width;  ///< of the views' grid
};
std::vector<LitLattice> lit_lattices() {
    return {{"foil", lit_foil(), 0.02, 0.7}, {"screen", lit_screen(), 0.004, 0.05}};
}

struct Comparison {
    double error = 0.0;     ///< relative RMS
    glm::dvec3 light{0.0};  ///< of all views, over the reference's
};
Comparison compare(const LitLattice& lit, const glm::dvec3& toward, const IncidentLight& incident,
                   const std::function<glm::dvec3(const ShadingPoint&)>& shade) {
    const std::vector<ShadingPoint> frames = views_around(toward, lit.half_width, 40);
    const auto expected = reference_radiance(lit.grating, incident, colour::LightSpectra(), frames);
    std::vector<glm::dvec3> found;
    Comparison comparison;
    glm::dvec3 whole(0.0);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        found.push_back(shade(frames[i]));
        comparison.light += found[i];
        whole += expected[i];
    }
    comparison.light /= whole;
    comparison.error = test::relative_rms(found, expected);
    return comparison;
}

/// Near the normal its picture is exact but for interpolation; between there and 45° two levels mix, and three look-ups
/// stand for an ellipse. The grid of views holds 2 % less of the light.
TEST(PatternLight, ALobeIsTheReferences) {
    const struct {
        double inclination_deg;
        double tolerance;
    } cases[] = {{12.6, 0.02}, {30.0, 0.055}, {45.0, 0.04}};
    for (const LitLattice& lit : lit_lattices())
        for (const auto& one : cases) {
            const double inclination = one.inclination_deg * std::numbers::pi / 180.0;
            const glm::dvec3 toward(0.894 * std::sin(inclination), -0.447 * std::sin(inclination),
                                    std::cos(inclination));
            const std::array<lighting::KeyLight, 1> lobe{{{.direction = glm::normalize(toward),
                                                           .flux = kFlux,
                                                           .concentration = 1.0 / (lit.deviation * lit.deviation)}}};
            const auto radiance = [&](const glm::dvec3& s) {
                return lighting::lobe_density(lobe[0], s) * lobe[0].flux;
            };
            const auto pictures = key_light_pictures(lit.grating, colour::LightSpectra(), lobe);
            const Comparison found = compare(
                lit, lobe[0].direction, light_of(radiance, lit.deviation),
                [&](const ShadingPoint& frame) { return pattern_radiance(pictures, std::nullopt, lobe, frame); });
            const std::string name = fmt::format("{}_{:.0f}", lit.name, one.inclination_deg);
            RecordProperty(name, fmt::format("{:.3g}", found.error));
            EXPECT_LT(found.error, one.tolerance) << name;
            for (int o = 0; o < 3; ++o) EXPECT_NEAR(found.light[o], 1.0, 0.04) << name;
        }
}

/// All light of a disc, and where it belongs; the disc's sharp edge is blurred, 35 % and 47 % measured.
TEST(PatternLight, ADiscSendsTheReferencesLight) {
    for (const LitLattice& lit : lit_lattices()) {
        const DirectLight disc{.direction = kToward, .flux = kFlux, .angular_radius = 2.0 * lit.deviation};
        const double cosine = std::cos(disc.angular_radius);
        const glm::dvec3 inside = kFlux / (2.0 * std::numbers::pi * (1.0 - cosine));
        const auto radiance = [&](const glm::dvec3& s) {
            return glm::dot(s, kToward) > cosine ? inside : glm::dvec3(0);
        };
        const PatternPicture picture = pattern_picture(lit.grating, colour::LightSpectra());
        const PatternLight light = pattern_light(disc, std::nullopt, glm::dmat3(1.0));
        const Comparison found = compare(
            lit, kToward, light_of(radiance, 0.2 * lit.deviation),
            [&](const ShadingPoint& frame) { return pattern_radiance(picture, light, glm::dvec2(frame.view)); });
        RecordProperty(lit.name, fmt::format("{:.3g}", found.error));
        EXPECT_LT(found.error, 0.5) << lit.name;
        for (int o = 0; o < 3; ++o) EXPECT_NEAR(found.light[o], 1.0, 0.05) << lit.name;
    }
}

/// A wide pixel has the mean of narrower ones.
TEST(PatternLight, AFootprintAveragesOverThePixel) {
    const PatternPicture picture = pattern_picture(lit_foil(), colour::LightSpectra());
    const PatternLight light{.irradiance = glm::dvec3(1.0), .centre = {0.0, 0.0}, .variance = 1e-6};
    glm::dvec3 wide(0.0);
    glm::dvec3 narrow(0.0);
    for (int i = -200; i <= 200; ++i)
        for (int j = -200; j <= 200; ++j) {
            const glm::dvec2 u = 0.008 * glm::dvec2(i, j);
            wide += pattern_radiance(picture, light, u, 0.1);
            narrow += pattern_radiance(picture, light, u, 0.02);
        }
    EXPECT_LT(glm::length(wide - narrow), 0.02 * glm::length(narrow));
}

}  // namespace
}  // namespace rowland::diffraction
