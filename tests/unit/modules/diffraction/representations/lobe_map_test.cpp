// Maps of lattices against the reference.

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>

#include "engine/lighting/procedural_probe.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/representations/planar/lobe_map.h"
#include "tests/support/files.h"
#include "tests/support/threads.h"
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

lighting::LightSamples smooth_texels() {
    return EvaluationLight(smooth_light(), math::SphericalWindow::None).texels();
}

Grating with_lobe(const GrooveLobe& lobe) {
    Grating grating = test::compact_disc();
    grating.lobe = lobe;
    return grating;
}

Grating lattice_of(const LatticeProfile& profile, const glm::dvec2& a_nm, const glm::dvec2& b_nm, int orders) {
    Grating grating;
    grating.orders.clear();
    grating.pitch_nm = glm::length(a_nm);
    grating.lattice = Lattice{.a_nm = a_nm, .b_nm = b_nm, .profile = profile, .orders = orders};
    return grating;
}

Grating crossed_foil() {
    return lattice_of(CrossedProfile{.along_a = SinusoidalProfile{120.0}, .along_b = SinusoidalProfile{90.0}},
                      {1000.0, 0.0}, {0.0, 1200.0}, 3);
}

Grating screen() {
    return lattice_of(ApertureProfile{.width_nm = 15000.0, .height_nm = 40000.0}, {50000.0, 0.0}, {0.0, 50000.0}, 12);
}

/// Nothing is symmetric: each sign of g, h, m and k shows.
Grating oblique_blaze() {
    return lattice_of(CrossedProfile{.along_a = BlazedProfile{250.0}, .along_b = BlazedProfile{150.0}}, {1400.0, 200.0},
                      {-300.0, 1800.0}, 2);
}

double map_error(const Grating& grating, const IncidentLight& light, const lighting::LightSamples& texels,
                 const std::vector<ShadingPoint>& frames, const LobeMapSize& size) {
    std::vector<ShadingPoint> points = frames;
    if (grating.transmission) std::transform(points.begin(), points.end(), points.begin(), lit_from_behind);
    const LobeSpectrum spectrum(shaded_pattern(grating, colour::LightSpectra()), size.views);
    const LobeMap map = fill_lobe_map(texels, spectrum, points[0].normal, size.azimuths);
    std::vector<glm::dvec3> found;
    for (const ShadingPoint& point : points) found.push_back(sample(map, point));
    return relative_rms(found, reference_radiance(grating, light, colour::LightSpectra(), frames));
}

/// The slow sum is the reference's quadrature. Light without detail: the rest is the map's steps of .03 at the
/// horizon's edge, 1.1 % for the lobe that is narrower than they are (measured), .4 % and less for the other lobes. Of
/// a lattice: steps of .025.
TEST(LobeMap, EqualsTheReferenceUnderSmoothLight) {
    Grating blazed = with_lobe(GaussianLobe{0.1});
    blazed.profile = BlazedProfile{.depth_nm = 280.0};
    blazed.orders = {0, 1, 2};
    Grating long_pits = with_lobe(PitsLobe{.length_nm = 3000.0, .coherent = 0.5});
    long_pits.pitch_nm = 740.0;
    const lighting::ShLight light = smooth_light();
    const lighting::LightSamples texels = smooth_texels();
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
    const std::vector<ShadingPoint> points = points_of(normal);
    Grating sheet = oblique_blaze();
    sheet.transmission = Transmission{.ior = 1.6};
    const std::pair<const char*, Grating> cases[] = {{"sigma 1", with_lobe(GaussianLobe{1.0})},
                                                     {"sigma 0.2", with_lobe(GaussianLobe{0.2})},
                                                     {"sigma 0.02", with_lobe(GaussianLobe{0.02})},
                                                     {"pits", with_lobe(PitsLobe{})},
                                                     {"incoherent pits", with_lobe(PitsLobe{.coherent = 0.0})},
                                                     {"long pits, fine pitch", long_pits},
                                                     {"pit sequence", with_lobe(PitSequenceLobe{})},
                                                     {"blazed", blazed},
                                                     {"crossed", crossed_foil()},
                                                     {"screen", screen()},
                                                     {"oblique blaze", oblique_blaze()},
                                                     {"sheet", sheet}};
    const std::vector<ShadingPoint> up_to_75_degrees(points.begin(), points.end() - 2);
    for (const auto& [name, grating] : cases) {
        const LobeMapViews views = grating.lattice ? LobeMapViews{.g = 96, .h = 80} : LobeMapViews{.g = 64, .h = 64};
        const double error = map_error(grating, light, texels, grating.lattice ? up_to_75_degrees : points,
                                       {.azimuths = 32, .views = views});
        EXPECT_LT(error, grating.lattice ? 0.021 : 0.012) << name;
        if (grating.lattice) continue;
        const LobeMap small = lobe_map(grating, texels, normal, {.azimuths = 8, .views = {.g = 8, .h = 8}});
        EXPECT_EQ(small.half_turn, std::string(name) != "blazed") << name;
    }
}

/// The narrowest lobe under a doorway of a few texels: .7 % measured, 2 % is the goal. The coarse map, which is shown
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
        return relative_rms(samples(lobe_map(grating, texels, frames[0].normal, size), frames), expected);
    };
    EXPECT_LT(error({}), 0.02);
    EXPECT_LT(error(kCoarseLobeMap), 0.15);
}

/// What is computed for the half turn alone is what the whole turn gives.
TEST(LobeMap, TheHalfTurnIsTheWholeTurn) {
    const lighting::LightSamples texels = smooth_texels();
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

TEST(LobeMap, FillingWhatPointsSeeGivesTheSame) {
    const lighting::LightSamples texels = smooth_texels();
    DiffractionPattern pattern = diffraction_pattern(with_lobe(PitsLobe{}), colour::LightSpectra());
    const glm::dvec3 normal(0, 0, 1);
    for (const bool even : {true, false}) {
        pattern.even = even;
        const LobeSpectrum spectrum(pattern, {.g = 16, .h = 24});
        const LobeMap all = fill_lobe_map(texels, spectrum, normal, 16);
        const auto of_points = lobe_map_of_points(texels, spectrum, normal, 16);
        for (const ShadingPoint& point : points_of(normal)) EXPECT_EQ(of_points(point), sample(all, point));
    }
}

TEST(LobeMap, AnyNumberOfThreadsGivesTheSameMap) {
    rowland::test::expect_same_on_any_threads([texels = smooth_texels()] {
        return lobe_map(with_lobe(PitsLobe{}), texels, {0, 1, 0}, {.azimuths = 16, .views = {.g = 16, .h = 16}}).values;
    });
}

TEST(LobeMap, AViewBelowTheHorizonIsBlack) {
    const LobeMap map =
        lobe_map(with_lobe(GaussianLobe{0.2}), smooth_texels(), {0, 0, 1}, {.azimuths = 8, .views = {.g = 8, .h = 8}});
    EXPECT_EQ(sample(map, {.view = {0.1, 0.2, -0.3}, .normal = {0, 0, 1}, .grating = {1, 0, 0}}), glm::dvec3(0.0));
}

/// Views around the orders of one lamp, a quarter of a step apart.
std::vector<ShadingPoint> dense_views() {
    const PlaneAxes axes = plane_axes({0.1, 0.9, 0.3});
    std::vector<ShadingPoint> frames;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) {
            const glm::dvec2 v(-0.5 + 0.015 * i, -0.3 + 0.015 * j);
            frames.push_back({.view = v.x * axes.e1 + v.y * axes.e2 + std::sqrt(1.0 - glm::dot(v, v)) * axes.n,
                              .normal = axes.n,
                              .grating = std::cos(0.4321) * axes.e1 + std::sin(0.4321) * axes.e2});
        }
    return frames;
}

/// A lamp 10 000 times as bright as the room: around its orders the map shows the room, not rings. Nine of ten views
/// are within 5 % of the reference (measured).
TEST(LatticeMapUnderALamp, HasNoRings) {
    const lighting::StudioRecipe room{.ceiling = glm::dvec3(0.02),
                                      .wall = glm::dvec3(0.035),
                                      .floor = glm::dvec3(0.02),
                                      .boxes = {{.azimuth_deg = 128.0,
                                                 .elevation_deg = 50.0,
                                                 .half_width_deg = 4.0,
                                                 .half_height_deg = 4.0,
                                                 .soft_edge_deg = 1.0,
                                                 .radiance = glm::dvec3(300.0)}}};
    const lighting::ProbeImage probe(lighting::render_studio(room, 1024), lighting::Mapping::Equirectangular);
    const std::vector<ShadingPoint> frames = dense_views();
    const LobeSpectrum spectrum(shaded_pattern(crossed_foil(), colour::LightSpectra()), {.g = 128, .h = 128});
    const LobeMap map = fill_lobe_map(lighting::light_samples(probe), spectrum, frames[0].normal, 512);
    const auto expected = reference_radiance(crossed_foil(), probe, colour::LightSpectra(), frames);
    std::vector<double> errors;
    for (std::size_t i = 0; i < frames.size(); ++i)
        errors.push_back(std::abs(sample(map, frames[i]).y / expected[i].y - 1.0));
    std::sort(errors.begin(), errors.end());
    const double most = errors[errors.size() * 9 / 10];
    EXPECT_LT(most, 0.1);
}

/// Of log₂ Y along a diagonal order of the brightest sample, so many steps of the views beside its middle: the largest
/// second difference over half a step.
double unevenness_of_a_streak(const LobeMap& map, const lighting::LightSamples& texels, double step, double beside) {
    const auto brightest = std::ranges::max_element(texels.green) - texels.green.begin();
    ShadingPoint point{.view = map.axes.n, .normal = map.axes.n, .grating = map.axes.e2};
    const glm::dmat3 to_tangent = world_to_tangent(point);
    const glm::dvec2 lamp(to_tangent * texels.direction(static_cast<std::size_t>(brightest)));
    std::vector<double> logarithms;
    for (int i = 0; i < 40; ++i) {
        const glm::dvec2 along(0.5 + 0.25 * step * i);
        const glm::dvec2 v = glm::sign(lamp) * (along + beside * step * glm::dvec2(0.7071, -0.7071)) - lamp;
        point.view = glm::transpose(to_tangent) * glm::dvec3(v, std::sqrt(1.0 - glm::dot(v, v)));
        logarithms.push_back(std::log2(sample(map, point).y));
    }
    double largest = 0.0;
    for (std::size_t i = 2; i + 2 < logarithms.size(); ++i)
        largest = std::max(largest, std::abs(logarithms[i - 2] - 2.0 * logarithms[i] + logarithms[i + 2]));
    return largest;
}

/// Linear interpolation between the views alone has .22: a staircase.
TEST(LobeSlice, ALampsStreakAcrossTheAxesHasNoSteps) {
    const lighting::StudioRecipe room{.ceiling = glm::dvec3(1e-4),
                                      .wall = glm::dvec3(1e-4),
                                      .floor = glm::dvec3(1e-4),
                                      .boxes = {{.azimuth_deg = 128.0,
                                                 .elevation_deg = 60.0,
                                                 .half_width_deg = 0.5,
                                                 .half_height_deg = 0.5,
                                                 .soft_edge_deg = 0.2,
                                                 .radiance = glm::dvec3(300.0)}}};
    const lighting::LightSamples texels = lighting::light_samples(
        lighting::ProbeImage(lighting::render_studio(room, 1024), lighting::Mapping::Equirectangular));
    const LobeMapViews views{.g = 128, .h = 128};
    const LobeSpectrum spectrum(shaded_pattern(crossed_foil(), colour::LightSpectra()), views);
    const PlaneAxes axes = plane_axes(glm::dvec3(0.0, 1.0, 0.0));
    const LobeMap map = fill_lobe_slice(texels, spectrum, axes.n, axes.e1);
    for (const double beside : {0.0, 0.5, 1.0, 1.5})
        EXPECT_LT(unevenness_of_a_streak(map, texels, views.step_g(), beside), 0.1) << beside;
}

/// How far a map is below 0, and outside of what the reference has within two nodes along both axes: as fractions of
/// the brightest there.
struct Deviation {
    double below_zero = 0.0;
    double outside = 0.0;
};

/// Along lines through the brightest lamp's brightest green order, of points half a node apart.
Deviation deviation_around_a_lamp(const Material& material, const lighting::ProbeImage& probe, const glm::dvec3& normal,
                                  int points) {
    const Grating& grating = material.grating;
    const PlanarLobe lobe = *bake(grating, std::get<PlanarSettings>(representation(material))).lobe;
    const LobeMapViews views = one_azimuth(lobe.size).views;
    const PlaneAxes axes = plane_axes(normal);
    const glm::dmat3 frame(axes.e1, axes.e2, axes.n);
    const auto point_at = [&](const glm::dvec2& v) -> ShadingPoint {
        const glm::dvec3 view(v, std::sqrt(std::max(0.05, 1.0 - glm::dot(v, v))));
        return {.view = frame * view, .normal = axes.n, .grating = axes.e1};
    };
    const bool behind = grating.transmission.has_value();
    const auto shaded = [&](const ShadingPoint& point) { return behind ? lit_from_behind(point) : point; };
    const ShadingPoint map_frame = shaded(point_at({0.0, 0.0}));
    const lighting::LightSamples texels = lighting::light_samples(probe);
    const LobeMap map = fill_lobe_slice(texels, LobeSpectrum(lobe.pattern, views), map_frame.normal, map_frame.grating);
    const glm::dmat3 to_tangent = world_to_tangent(map_frame);
    glm::dvec3 lamp(0.0);
    double brightest = 0.0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const glm::dvec3 s = to_tangent * texels.direction(i);
        if (s.z < 0.15 || texels.green[i] < brightest) continue;
        brightest = texels.green[i];
        lamp = s;
    }
    const DiffractionPattern::Node* order = nullptr;
    for (const auto& node : lobe.pattern.nodes)
        if (std::abs(node.wavelength_nm - 550.0F) < 8.0F && glm::length(glm::dvec2(node.u) - glm::dvec2(lamp)) < 0.7 &&
            (order == nullptr || node.weight[1][1] > order->weight[1][1]))
            order = &node;
    Deviation worst;
    if (order == nullptr) return worst;
    const double mirrored = behind ? -1.0 : 1.0;  // of h
    for (const int axis : {0, 1}) {
        std::array<std::vector<glm::dvec3>, 5> reference;  // of lines beside each other, a node apart
        std::vector<glm::dvec3> shown;
        for (int side = 0; side < 5; ++side) {
            std::vector<ShadingPoint> line;
            for (int i = 0; i < points; ++i) {
                const int offset = i - points / 2;
                const double along = 0.5 * offset;
                const glm::dvec2 nodes = axis == 0 ? glm::dvec2(along, side - 2) : glm::dvec2(side - 2, along);
                glm::dvec2 v = glm::dvec2(order->u) - glm::dvec2(lamp);
                v = glm::dvec2(v.x, mirrored * v.y) + nodes * glm::dvec2(views.step_g(), views.step_h());
                line.push_back(point_at(v));
                if (side != 2) continue;
                const double passed = transmittance(grating.cover, glm::dot(line.back().normal, line.back().view));
                shown.push_back(passed * sample(map, shaded(line.back())));
            }
            reference[static_cast<std::size_t>(side)] =
                reference_radiance(grating, probe, colour::LightSpectra(), line);
        }
        for (std::size_t i = 4; i + 4 < shown.size(); ++i) {
            double least = 1e30;
            double most = 0.0;
            for (const auto& line : reference)
                for (std::size_t j = i - 4; j <= i + 4; ++j) {
                    least = std::min(least, line[j].y);
                    most = std::max(most, line[j].y);
                }
            if (most == 0.0) continue;
            worst.below_zero = std::max(worst.below_zero, -glm::compMin(shown[i]) / most);
            worst.outside = std::max({worst.outside, (least - shown[i].y) / most, (shown[i].y - most) / most});
        }
    }
    return worst;
}

/// Captures that Debian's blender-data installs.
void expect_no_rings(const std::string& capture, const std::vector<const char*>& materials, int points) {
    const std::filesystem::path path = "/usr/share/blender/datafiles/studiolights/world/" + capture + ".exr";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no captures of light (package blender-data)";
    const lighting::ProbeImage probe(image::load_image(path), lighting::Mapping::Equirectangular);
    for (const char* name : materials) {
        const Material material = load_material(rowland::test::content_path(fmt::format("materials/{}.json", name)));
        const Deviation found =
            deviation_around_a_lamp(material, probe, glm::normalize(glm::dvec3(-0.3, 0.3, 0.9)), points);
        EXPECT_LT(found.below_zero, 0.002) << capture << " " << name;
        EXPECT_LT(found.outside, 0.05) << capture << " " << name;
    }
}

/// Lamps 10 000 times as bright as the room. A map that undid its blur by a filter which ends at one frequency was
/// below 0 by 11 % and 49 % outside the reference.
TEST(LobeMapAroundALamp, IsNeverNegativeAndHasNoStripes) {
    expect_no_rings("interior", {"crossed_foil"}, 41);
}

/// Each material under the two captures with the smallest lamps, and under two or three of the others.
TEST(EveryLobeMapAroundALamp, IsNeverNegativeAndHasNoStripes) {
    const std::vector<const char*> materials = {"crossed_foil", "butterfly_wing", "phone_screen", "diffraction_glasses",
                                                "feather"};
    for (const char* capture : {"interior", "night"}) expect_no_rings(capture, materials, 25);
    std::size_t next = 0;
    for (const char* capture : {"city", "courtyard", "forest", "studio", "sunrise", "sunset"}) {
        expect_no_rings(capture, {materials[next % 5], materials[(next + 2) % 5]}, 25);
        ++next;
    }
}

struct LatticeProbe {
    const char* name;
    const char* file;
    lighting::Mapping mapping;
};

class LatticeMap : public testing::TestWithParam<LatticeProbe> {};

/// The view that deviates most does not count if the reference itself is 2 % off by its own account: of the foil under
/// Ennis' doorway one is, by 5 %.
void leave_out_the_doubtful(const Grating& grating, const lighting::ProbeImage& probe,
                            const std::vector<ShadingPoint>& frames, std::vector<glm::dvec3>& found,
                            std::vector<glm::dvec3>& expected) {
    std::size_t worst = 0;
    for (std::size_t i = 0; i < frames.size(); ++i)
        if (glm::distance(found[i], expected[i]) > glm::distance(found[worst], expected[worst])) worst = i;
    const auto checked = checked_reference(grating, probe, colour::LightSpectra(), std::span(frames).subspan(worst, 1));
    if (checked[0].error > 0.02) found[worst] = expected[worst] = glm::dvec3(0.0);
}

/// The shipped materials on objects of one g, in the maps that they have there.
TEST_P(LatticeMap, OfOneAzimuthIsWithinTwoPerCentOfTheReference) {
    ROWLAND_TEST_DATA(path, std::string("probes/") + GetParam().file);
    ROWLAND_TEST_DATA(frames_path, "oracle/frames_tilted_cd.csv");
    std::vector<ShadingPoint> frames = test::read_frames(rowland::test::read_csv(frames_path));
    const glm::dvec3 g = frames[0].grating;
    for (ShadingPoint& frame : frames) frame.grating = g;
    const lighting::ProbeImage probe(image::load_image(path), GetParam().mapping);
    const lighting::LightSamples texels = lighting::light_samples(probe);
    for (const char* name : {"crossed_foil", "phone_screen", "butterfly_wing"}) {
        const Material material = load_material(rowland::test::content_path(fmt::format("materials/{}.json", name)));
        const Grating& grating = material.grating;
        const auto settings = std::get<PlanarSettings>(representation(material));
        const PlanarLobe lobe = *bake(grating, settings).lobe;
        const LobeSpectrum spectrum(lobe.pattern, one_azimuth(lobe.size).views);
        const LobeMap map = fill_lobe_slice(texels, spectrum, frames[0].normal, g);
        std::vector<glm::dvec3> found;
        for (const ShadingPoint& frame : frames)
            found.push_back(transmittance(grating.cover, glm::dot(frame.normal, frame.view)) * sample(map, frame));
        std::vector<glm::dvec3> expected = reference_radiance(grating, probe, colour::LightSpectra(), frames);
        leave_out_the_doubtful(grating, probe, frames, found, expected);
        const double error = relative_rms(found, expected);
        EXPECT_LT(error, 0.02) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Probes, LatticeMap,
    testing::Values(LatticeProbe{"Ennis", "ennis_probulator.hdr", lighting::Mapping::Equirectangular},
                    LatticeProbe{"Grace", "grace_probe.hdr", lighting::Mapping::Angular},
                    LatticeProbe{"BlenderSunset", "blender_sunset.exr", lighting::Mapping::Equirectangular}),
    [](const auto& probe) { return std::string(probe.param.name); });

}  // namespace
}  // namespace rowland::diffraction
