// Small lights on lattices, in one look-up each.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <array>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "engine/math/quadrature.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "tests/unit/modules/diffraction/gratings.h"
#include "tests/unit/modules/diffraction/reference/oracle.h"

namespace rowland::diffraction {
namespace {

using test::compact_disc;
using test::relative_rms;

/// The tangent frame is the world's: g = x, h = y, n = z.
ShadingPoint frame_of(double v_g, double v_h) {
    return {.view = {v_g, v_h, std::sqrt(1.0 - v_g * v_g - v_h * v_h)}, .normal = {0, 0, 1}, .grating = {1, 0, 0}};
}

std::vector<ShadingPoint> frames() {
    std::vector<ShadingPoint> result;
    for (int i = 0; i < 60; ++i) result.push_back(frame_of(-0.95 + 1.9 * i / 59, 0.1));
    return result;
}

struct Kernels {
    ColourKernel exact;
    KernelTable table;
    BlurredKernel blurred;
    explicit Kernels(const Grating& grating)
        : exact(grating, colour::LightSpectra()),
          table(tabulate(exact)),
          blurred(blur(table, grating.pitch_nm, 0.25 * grating.pitch_nm)) {}
};

template <typename Kernel, typename Light>
std::vector<glm::dvec3> radiance(const Kernel& kernel, const DirectMaterial& material, const Light& light) {
    std::vector<glm::dvec3> xyz;
    for (const ShadingPoint& frame : frames())
        xyz.push_back(direct_radiance(kernel, material, light_spot(light, world_to_tangent(frame)),
                                      {frame.view.x, frame.view.y, 0.0}));
    return xyz;
}

/// ∫ flux · density(s) s_n⁺ ½ 2D_h d k(d(s_g + v_g)) dω over all directions around `axis`, by brute force: rings of
/// the cap cos θ > cosine_end, Gauss–Legendre in cos θ, even in angle.
template <typename Density>
std::vector<glm::dvec3> by_quadrature(const ColourKernel& kernel, double pitch_nm, const GrooveLobe& lobe,
                                      const glm::dvec3& axis, const glm::dvec3& flux, double cosine_end,
                                      const Density& density) {
    const glm::dvec3 side = glm::normalize(glm::cross(axis, glm::dvec3(0.3, 0.5, 1.0)));
    const glm::dvec3 other = glm::cross(axis, side);
    const math::QuadratureRule rule = math::gauss_legendre(96, cosine_end, 1.0);
    constexpr int kAngles = 240;
    std::vector<glm::dvec3> xyz(frames().size(), glm::dvec3(0.0));
    const auto all = frames();
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
        for (int j = 0; j < kAngles; ++j) {
            const double angle = 2.0 * std::numbers::pi * (j + 0.5) / kAngles;
            const double sine = std::sqrt(1.0 - rule.nodes[i] * rule.nodes[i]);
            const glm::dvec3 s = rule.nodes[i] * axis + sine * (std::cos(angle) * side + std::sin(angle) * other);
            if (s.z <= 0.0) continue;
            const double weight = rule.weights[i] * 2.0 * std::numbers::pi / kAngles * density(s) * s.z;
            for (std::size_t k = 0; k < all.size(); ++k)
                xyz[k] += weight * lobe_density(lobe, s.y + all[k].view.y, 550.0) * pitch_nm *
                          (kernel(pitch_nm * (s.x + all[k].view.x)) * flux);
        }
    return xyz;
}

std::vector<glm::dvec3> exact(const Kernels& kernels, const GrooveLobe& lobe, const lighting::KeyLight& key) {
    return by_quadrature(kernels.exact, 1600.0, lobe, key.direction, key.flux,
                         std::max(-1.0, 1.0 - 30.0 / key.concentration),
                         [&](const glm::dvec3& s) { return lighting::lobe_density(key, s); });
}

glm::dvec3 toward(double s_g, double s_n) {
    return {s_g, std::sqrt(1.0 - s_g * s_g - s_n * s_n), s_n};
}

/// PHYSICS §4: ½ s_n d Σ_c F_c k(d u). 1e-3: a box of 2e-4 in place of a point.
TEST(Direct, PunctualLightIsTheKernelItself) {
    const Kernels kernels(compact_disc());
    const DirectLight light{toward(0.3, 0.6), {1.0, 0.5, 0.25}, 0.0};
    std::vector<glm::dvec3> expected;
    for (const ShadingPoint& frame : frames())
        expected.push_back(0.5 * 0.6 * 1600.0 * (kernels.exact(1600.0 * (0.3 + frame.view.x)) * light.flux));
    EXPECT_LT(relative_rms(radiance(kernels.exact, {1600.0}, light), expected), 1e-3);
    EXPECT_LT(relative_rms(radiance(kernels.table, {1600.0}, light), expected), 0.01);    // steps of 1.5 nm
    EXPECT_LT(relative_rms(radiance(kernels.blurred, {1600.0}, light), expected), 0.02);  // columns of 3 nm
}

TEST(Direct, DiscIsItsArcIntegral) {
    const Kernels kernels(compact_disc());
    for (const double radius : {0.005, 0.05, 0.15}) {
        const DirectLight light{toward(0.3, 0.6), {1.0, 0.5, 0.25}, radius};
        const double solid_angle = 2.0 * std::numbers::pi * (1.0 - std::cos(radius));
        const auto expected = by_quadrature(kernels.exact, 1600.0, FlatLobe{}, light.direction, light.flux,
                                            std::cos(radius), [&](const glm::dvec3&) { return 1.0 / solid_angle; });
        // Measured .025 and .083 for the wider two: a box has the disc's variance, not its round shape or its tilt.
        const double tolerance = radius < 0.01 ? 0.002 : radius < 0.1 ? 0.03 : 0.09;
        EXPECT_LT(relative_rms(radiance(kernels.exact, {1600.0}, light), expected), tolerance) << radius;
    }
}

/// A lobe against its own integral: slices measured .0025 at most, of 𝒦 and of the smoothed kernel.
TEST(Direct, LobeIsItsArcIntegral) {
    const Kernels kernels(compact_disc());
    for (const double concentration : {40.0, 100.0, 400.0, 2000.0})
        for (const double s_n : {0.9, 0.5, 0.2, 0.03, -0.05}) {
            const lighting::KeyLight key{toward(0.35, s_n), {1.0, 0.5, 0.25}, concentration};
            const auto expected = exact(kernels, FlatLobe{}, key);
            const double slices = relative_rms(radiance(kernels.table, {1600.0}, key), expected);
            const double smoothed = relative_rms(radiance(kernels.blurred, {1600.0}, key), expected);
            EXPECT_LT(slices, 0.004) << concentration << " " << s_n;
            EXPECT_LT(smoothed, 0.004) << concentration << " " << s_n;
        }
}

/// A look-up is as wide as it is asked to be, though columns of 3 nm and interpolation have a width of their own. The
/// lobes are the sun and the narrowest one. Measured: .0016 and .0051; .013 and .034 for levels from 4 nm on.
TEST(Direct, NarrowLobesAreTheirSlices) {
    const Kernels kernels(compact_disc());
    const BlurredKernel fine = blur(kernels.table, 1600.0, 0.25 * 1600.0, 2048, 8);
    for (const double concentration : {1.6e5, lighting::kNarrowestConcentration}) {
        const lighting::KeyLight key{toward(0.35, 0.9), {1.0, 0.5, 0.25}, concentration};
        std::vector<glm::dvec3> one_look;
        for (const ShadingPoint& frame : frames()) {
            LightSpot spot = light_spot(key, world_to_tangent(frame));
            spot.concentration = 0.0;  // one normal distribution
            one_look.push_back(direct_radiance(fine, {1600.0}, spot, {frame.view.x, frame.view.y, 0.0}));
        }
        const double error = relative_rms(one_look, radiance(kernels.table, {1600.0}, key));
        EXPECT_LT(error, concentration < 2e5 ? 0.002 : 0.006) << concentration;
    }
}

/// About g the lobe ends at s_g = 1. Slices measured .0054 at most.
TEST(Direct, LobeAboutTheGratingVectorIsItsArcIntegral) {
    const Kernels kernels(compact_disc());
    for (const double concentration : {40.0, 400.0})
        for (const double s_g : {0.9, 0.95, 0.998})
            for (const double s_n : {0.3, 0.06, 0.0}) {
                if (std::hypot(s_g, s_n) >= 1.0) continue;
                const lighting::KeyLight key{toward(s_g, s_n), {1.0, 0.5, 0.25}, concentration};
                const auto expected = exact(kernels, FlatLobe{}, key);
                const double error = relative_rms(radiance(kernels.table, {1600.0}, key), expected);
                EXPECT_LT(error, 0.008) << concentration << " " << s_g << " " << s_n;
            }
}

TEST(Direct, LobeBelowTheHorizonIsBlack) {
    const Kernels kernels(compact_disc());
    const lighting::KeyLight key{toward(0.1, -0.9), glm::dvec3(1.0), 400.0};
    for (const glm::dvec3& xyz : radiance(kernels.table, {1600.0}, key)) EXPECT_LT(glm::length(xyz), 1e-12);
    const DirectLight lamp{toward(0.1, -0.9), glm::dvec3(1.0), 0.01};
    for (const glm::dvec3& xyz : radiance(kernels.table, {1600.0}, lamp)) EXPECT_EQ(xyz, glm::dvec3(0.0));
}

/// 2 D_h, widened by the lobe's own extent. Measured 4.1 %: the lobe's s_g and s_h are not independent.
TEST(Direct, GaussianGroovesWeightTheLobe) {
    const Kernels kernels(compact_disc());
    const GrooveLobe grooves = GaussianLobe{0.2};
    const lighting::KeyLight key{toward(0.3, 0.9), {1.0, 0.5, 0.25}, 200.0};
    const auto expected = exact(kernels, grooves, key);
    EXPECT_LT(relative_rms(radiance(kernels.table, {1600.0, glm::dmat3(0.0), grooves}, key), expected), 0.05);
    EXPECT_GT(relative_rms(radiance(kernels.table, {1600.0}, key), expected), 0.2);
}

/// The slow sum is the convolution with the light's normal distribution, 2000 steps over ±6 deviations.
TEST(Direct, ALightWidensEachOrderOfAPitSequence) {
    const GrooveLobe grooves = PitSequenceLobe{};
    for (const double deviation : {0.0, 0.01, 0.2}) {
        const LightSpot spot{.centre_h = 0.1, .deviation_h = deviation};
        const glm::dvec3 found = groove_factor(grooves, spot, 0.3);
        for (int o = 0; o < 3; ++o) {
            const LobeDensity density(grooves, kPitsWavelengths_nm[o]);
            double expected = deviation == 0.0 ? 2.0 * density(0.4) : 0.0;
            constexpr int kSteps = 2000;
            for (int i = 0; i < kSteps && deviation > 0.0; ++i) {
                const double x = 6.0 * ((2.0 * i + 1.0) / kSteps - 1.0);
                expected += 2.0 * 12.0 / kSteps * std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi) *
                            density(0.4 + x * deviation);
            }
            EXPECT_NEAR(found[o], expected, 1e-6 * expected) << deviation << " " << o;
        }
    }
}

/// A pixel's footprint is a mean over u.
TEST(Direct, FootprintIsTheMeanOverThePixel) {
    const Kernels kernels(compact_disc());
    const DirectLight light{toward(0.3, 0.6), glm::dvec3(1.0), 0.0};
    const LightSpot spot = light_spot(light, world_to_tangent(frame_of(0.0, 0.0)));
    const double footprint = 0.08;
    glm::dvec3 mean(0.0);
    constexpr int kSteps = 400;
    for (int i = 0; i < kSteps; ++i)
        mean += direct_radiance(kernels.exact, {1600.0}, spot, {0.1 + footprint * ((2 * i + 1.0) / kSteps - 1.0)}) /
                double(kSteps);
    const glm::dvec3 found = direct_radiance(kernels.exact, {1600.0}, spot, {0.1, 0.0, footprint});
    EXPECT_LT(glm::length(found - mean), 1e-3 * glm::length(mean));
}

TEST(Direct, SumsUpTo64LightsOverTheHorizonOnly) {
    const Kernels kernels(compact_disc());
    std::vector<lighting::KeyLight> keys;
    glm::dvec3 sum(0.0);
    const ShadingPoint frame = frame_of(0.2, 0.1);
    for (int i = 0; i < lighting::kMaximumKeyLights; ++i) {
        keys.push_back({toward(-0.9 + 0.02 * i, 0.3), glm::dvec3(1.0 + i), 100.0 + i});
        sum += direct_radiance(kernels.table, {1600.0}, light_spot(keys.back(), world_to_tangent(frame)), {0.2, 0.1});
    }
    const std::span<const lighting::KeyLight> all(keys);
    EXPECT_LT(glm::length(direct_radiance(kernels.table, {1600.0}, all, frame) - sum), 1e-12 * glm::length(sum));
    ShadingPoint below = frame;
    below.view.z = -below.view.z;
    EXPECT_EQ(direct_radiance(kernels.table, {1600.0}, all, below), glm::dvec3(0.0));
}

/// Order 0 under a lobe has the power of the mirror image: ∫ over v_g of its part is ½ s_n Z F.
TEST(Direct, ZeroOrderIntegratesToItsEfficiency) {
    Grating mirror = compact_disc();
    mirror.orders = {0};
    const ColourKernel kernel(mirror, colour::LightSpectra());
    const DirectMaterial material{1600.0, kernel.zero_order_xyz()};
    const LightSpot spot =
        light_spot(DirectLight{toward(0.1, 0.8), glm::dvec3(1.0), 0.1}, world_to_tangent(frame_of(0, 0)));
    glm::dvec3 sum(0.0);
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i)
        sum += direct_radiance(kernel, material, spot, {-1.0 + (2 * i + 1.0) / kSteps}) * (2.0 / kSteps);
    const glm::dvec3 expected = 0.5 * spot.cosine * (kernel.zero_order_xyz() * glm::dvec3(1.0));
    EXPECT_LT(glm::length(sum - expected), 1e-3 * glm::length(expected));
}

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
