// Key lights and the bands that they leave, under captured probes.

#include "engine/image/image.h"
#include "engine/lighting/probe_image.h"
#include "modules/diffraction/bake/arc_moments.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/representations/arc/arc_table.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "tests/support/files.h"
#include "tests/support/threads.h"
#include "tests/unit/modules/diffraction/gratings.h"
#include "tests/unit/modules/diffraction/representations/baked_views.h"

namespace rowland::diffraction {
namespace {

using test::compact_disc;
using test::foil;
using test::relative_rms;

constexpr int kEverything = 1000;

/// PHYSICS §9 for the full rank: 1e-4; the task's bound for R = 8: 3 %. Rank costs less with every four more.
TEST(ArcTable, MatchesTheBandlimitedOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    for (const test::OracleCase& one : test::read_cases(path)) {
        if (!is_flat(one.grating.lobe)) continue;
        const auto views = test::tangent_views(light, one.frames);
        const auto error = [&](int rank) {
            return relative_rms(test::evaluated(bake(one.grating, ArcSettings{.rank = rank}), views), one.xyz);
        };
        EXPECT_LT(error(8), 0.03) << one.name;
        EXPECT_LT(error(16), 0.002) << one.name;
        EXPECT_LT(error(kEverything), 1e-4) << one.name;
    }
}

/// ‖Σ_c x_c‖² of light whose channels have power 1 and correlate by .9.
double channel_power(const glm::dmat3& x) {
    const glm::dvec3 grey = x[0] + x[1] + x[2];
    return 0.9 * glm::dot(grey, grey) + 0.1 * (glm::dot(x[0], x[0]) + glm::dot(x[1], x[1]) + glm::dot(x[2], x[2]));
}

/// ‖T − w U‖/‖T‖ for light whose power falls with the band as 1/(l+1)²: what the weights are chosen for.
double table_error(const Grating& grating, int rank) {
    const ArcTable table = bake(grating, ArcSettings{.rank = rank, .storage = Storage::Float});
    const TransferTerms terms(grating, colour::LightSpectra(), table.bands);
    const ArcMoments moments(table.bands);
    const auto columns = static_cast<std::size_t>(table.grid.columns);
    double difference = 0.0;
    double scale = 0.0;
    for (std::size_t node = 0; node < columns; node += 8) {
        const auto exact = terms.coefficients(node_view(table.grid, static_cast<int>(node), 0).x, 0.0);
        for (std::size_t i = 0; i < exact.size(); ++i) {
            glm::dmat3 found(0.0);
            for (std::size_t r = 0; r < static_cast<std::size_t>(table.rank); ++r)
                for (std::size_t k = 0; k < 9; ++k)
                    found += table.value(r / 4, r / 4 * columns + node, r % 4) * moments.matrix()[k * 25 + i] *
                             glm::dmat3(table.factors[r * 9 + k]);
            const double band = 1.0 + std::floor(std::sqrt(static_cast<double>(i)));
            difference += channel_power(found - exact[i]) / (band * band);
            scale += channel_power(exact[i]) / (band * band);
        }
    }
    return std::sqrt(difference / scale);
}

/// MEASUREMENTS §5: 8–11 / 3–5 / 2 / 0.4 / 0.1 % for R = 4 / 6 / 8 / 12 / 16; here 6–9 / 3–5 / 1–2 / .4 / .04–.1 %
/// (measured).
TEST(ArcTable, TableErrorFallsWithTheRank) {
    Grating dvd{.pitch_nm = 740.0, .profile = LamellarProfile{0.4, 120.0}, .orders = {-1, 1}};
    Grating card{.pitch_nm = 1000.0, .profile = SinusoidalProfile{200.0}, .orders = {-2, -1, 1, 2}};
    for (const auto& [name, grating] :
         {std::pair<const char*, Grating>{"disc", compact_disc()}, {"dvd", dvd}, {"card", card}})
        for (const auto& [rank, bound] :
             {std::pair{4, 0.11}, {6, 0.055}, {8, 0.025}, {12, 0.005}, {16, 0.0012}, {kEverything, 1e-6}}) {
            const double error = table_error(grating, rank);
            EXPECT_LT(error, bound) << name << " " << rank;
        }
}

/// Real light, band-limited: R = 8 costs .3–1.5 % (measured), 3 % allowed.
TEST(ArcTable, RankEightIsEnoughForARealProbe) {
    ROWLAND_TEST_DATA(frames_path, "oracle/frames_tilted_cd.csv");
    ROWLAND_TEST_DATA(probe_path, "probes/grace_probe.hdr");
    const lighting::ProbeImage probe(image::load_image(probe_path), lighting::Mapping::Angular);
    const auto views =
        test::tangent_views(lighting::project(probe, 5), test::read_frames(rowland::test::read_csv(frames_path)));
    const auto exact = test::evaluated(bake(compact_disc(), ArcSettings{.rank = kEverything}), views);
    EXPECT_LT(relative_rms(test::evaluated(bake(compact_disc(), ArcSettings{.rank = 8}), views), exact), 0.03);
}

/// XYZ of a view under light in its tangent frame by the coefficients that an arc table compresses.
glm::dvec3 by_coefficients(const TransferTerms& terms, const lighting::ShLight& tangent_light, const glm::dvec2& view) {
    const std::vector<glm::dmat3> coefficients = terms.coefficients(view.x, view.y);
    glm::dvec3 xyz(0.0);
    for (std::size_t i = 0; i < coefficients.size(); ++i) xyz += coefficients[i] * tangent_light.coefficients[i];
    return xyz;
}

/// At the nodes of its grid, those baked as mirrored views included: at full rank to fp32.
TEST(ArcTable, OfALobeErrsByItsRankAlone) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const ViewGrid grid{ViewMapping::Parabolic, 10, 10};
    const TransferTerms terms(foil(), colour::LightSpectra(), light.bands);
    std::vector<test::TangentView> views;
    std::vector<glm::dvec3> expected;
    for (const int column : {2, 5, 7})
        for (const int row : {3, 5, 7}) {
            const glm::dvec2 at = node_view(grid, column, row);
            views.push_back({light, {at, std::sqrt(1.0 - glm::dot(at, at))}});
            expected.push_back(by_coefficients(terms, light, at));
        }
    for (const auto& [rank, bound] : {std::pair{8, 0.1}, {16, 0.05}, {kEverything, 1e-5}}) {
        const ArcTable table = bake(foil(), ArcSettings{.rank = rank, .grid = grid, .storage = Storage::Float});
        EXPECT_EQ(table.terms, LightTerms::Harmonics);
        const double error = relative_rms(test::evaluated(table, views), expected);
        EXPECT_LT(error, bound) << rank;
    }
}

/// The foil's lobe by the default table, 64 × 32, at full rank: .3 % of interpolation on other frames (measured), 1 %
/// allowed.
TEST(ArcTable, MatchesTheBandlimitedOracleForALobe) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const test::OracleCase one = test::read_cases(path).back();
    ASSERT_EQ(one.name, "foil_lobe");
    const auto views = test::tangent_views(test::read_sh_light(light_path), one.frames);
    const double error =
        relative_rms(test::evaluated(bake(one.grating, ArcSettings{.rank = kEverything}), views), one.xyz);
    EXPECT_LT(error, 0.01);
}

/// Pitches off the table's nodes, against tables baked for just these: 33 nodes over two octaves leave 1e-3.
TEST(ArcTable, PitchAxisFollowsThePitch) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const test::OracleCase one = test::read_cases(path).front();
    const auto views = test::tangent_views(test::read_sh_light(light_path), one.frames);
    const ArcTable table = bake(one.grating, ArcSettings{.rank = kEverything, .pitch = PitchAxis{.nodes = 33}});
    EXPECT_EQ(table.rows(), 33);
    for (const double factor : {0.5, 0.613, 1.0, 1.77, 2.0}) {
        Grating scaled = one.grating;
        scaled.pitch_nm *= factor;  // and the slit, so that the efficiencies stay
        scaled.profile = SlitProfile{800.0 * factor};
        std::vector<glm::dvec3> found;
        for (const auto& view : views) found.push_back(evaluate(table, view.light, view.view, factor));
        const double error =
            relative_rms(found, test::evaluated(bake(scaled, ArcSettings{.rank = kEverything}), views));
        EXPECT_LT(error, 3e-3) << factor;
    }
}

TEST(ArcTable, VertexAndPixelPartsAreTheWhole) {
    const ArcTable table = bake(compact_disc(), ArcSettings{.bands = 3, .rank = 5});
    lighting::ShLight light{3, {}};
    for (int i = 0; i < 9; ++i) light.coefficients.emplace_back(1.0 + i, 2.0 - 0.1 * i, 0.3);
    const glm::dvec3 view(0.3, 0.2, std::sqrt(1.0 - 0.13));
    const auto products = light_products(table, ArcMoments(3)(light));
    EXPECT_EQ(products.size(), 5U);
    EXPECT_EQ(shade(table, products, view), evaluate(table, light, view));
    EXPECT_EQ(shade(table, products, {0.6, 0.0, -0.8}), glm::dvec3(0.0));
}

TEST(ArcTable, SubwavelengthPitchIsExactlyBlack) {
    const Grating fine{.pitch_nm = 150.0, .profile = SlitProfile{75.0}};
    EXPECT_EQ(evaluate(bake(fine, ArcSettings{}), {1, {glm::dvec3(1.0)}}, {0.3, 0.1, 0.9}), glm::dvec3(0.0));
}

TEST(ArcTable, RefusesFewGroovesAndForALobeAPitchAxisAndOneDimension) {
    EXPECT_THROW(bake(foil(), ArcSettings{.pitch = PitchAxis{}}), Error);
    EXPECT_THROW(bake(foil(), ArcSettings{.grid = ViewGrid{ViewMapping::OneDimensional, 16, 1}}), Error);
    Grating few = compact_disc();
    few.grooves = 10.0;
    EXPECT_THROW(bake(few, ArcSettings{}), Error);
}

TEST(ArcTable, BytesDoNotDependOnTheNumberOfThreads) {
    rowland::test::expect_same_on_any_threads([] { return test::written(bake(compact_disc(), ArcSettings{})); });
}

TEST(ArcTable, HasSoundBytes) {
    ArcSettings settings{.bands = 2, .rank = 3, .grid = ViewGrid{ViewMapping::OneDimensional, 9, 1}};
    settings.storage = Storage::Unorm16;
    test::expect_sound_bytes(bake(compact_disc(), settings), read_arc_table);
    settings.pitch = PitchAxis{.nodes = 4};
    test::expect_sound_bytes(bake(compact_disc(), settings), read_arc_table);
    const ArcSettings lobe{.bands = 2, .rank = 5, .grid = ViewGrid{ViewMapping::Parabolic, 4, 5}};
    test::expect_sound_bytes(bake(foil(), lobe), read_arc_table);
}

/// XYZ of a compact disc by five bands and key lights.
std::vector<glm::dvec3> lit(const lighting::ProbeImage& probe, int key_lights, std::span<const ShadingPoint> frames) {
    static const ArcTable table = bake(compact_disc(), ArcSettings{.rank = 16});
    static const KernelTable kernel = tabulate(ColourKernel(compact_disc(), colour::LightSpectra(colour::d65())));
    const EvaluationLight light(probe, key_lights, math::SphericalWindow::None);
    std::vector<glm::dvec3> xyz = test::evaluated(table, test::tangent_views(light.harmonics(5), frames));
    for (std::size_t i = 0; i < xyz.size(); ++i)
        xyz[i] += direct_radiance(kernel, {.pitch_nm = 1600.0}, light.key_lights(), frames[i]);
    return xyz;
}

struct CapturedProbe {
    std::string name;
    std::string file;
    lighting::Mapping mapping = lighting::Mapping::Equirectangular;
    double tolerance = 0.08;
};

class ArcWithKeyLights : public ::testing::TestWithParam<CapturedProbe> {};

/// Measured: .078 under Ennis (a doorway that the disc turns away from), .073 under Grace, .017 under Blender Sunset,
/// .024 under Royal Esplanade. The fit under Ennis is the most sensitive to rounding, by a tenth.
TEST_P(ArcWithKeyLights, MatchesTheOracleOfTheTiltedDisc) {
    const CapturedProbe& one = GetParam();
    ROWLAND_TEST_DATA(probe_path, "probes/" + one.file);
    ROWLAND_TEST_DATA(frames_path, "oracle/frames_tilted_cd.csv");
    ROWLAND_TEST_DATA(oracle_path, "oracle/radiance_tilted_cd_" + one.name + ".csv");
    const auto frames = test::read_frames(rowland::test::read_csv(frames_path));
    const lighting::ProbeImage probe(image::load_image(probe_path), one.mapping);
    const double error =
        test::relative_rms(lit(probe, 32, frames), test::read_xyz(rowland::test::read_csv(oracle_path)));
    EXPECT_LT(error, one.tolerance);
}

INSTANTIATE_TEST_SUITE_P(Captured, ArcWithKeyLights,
                         ::testing::Values(CapturedProbe{"grace", "grace_probe.hdr", lighting::Mapping::Angular},
                                           CapturedProbe{
                                               .name = "ennis", .file = "ennis_probulator.hdr", .tolerance = 0.09},
                                           CapturedProbe{"blender_sunset", "blender_sunset.exr"},
                                           CapturedProbe{"royal_esplanade", "royal_esplanade_1k.hdr"}),
                         [](const auto& one) { return one.param.name; });

class ArcWithoutKeyLights : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

/// However few the lights.
TEST_P(ArcWithoutKeyLights, IsFartherFromTheReference) {
    ROWLAND_TEST_DATA(path, std::string("probes/") + GetParam().second);
    ROWLAND_TEST_DATA(frames_path, "oracle/frames_tilted_cd.csv");
    const std::vector<ShadingPoint> all = test::read_frames(rowland::test::read_csv(frames_path));
    std::vector<ShadingPoint> frames;  // of the whole disc: its parts show different light
    for (std::size_t i = 0; i < all.size(); i += 3) frames.push_back(all[i]);
    const lighting::ProbeImage probe(image::load_image(path), lighting::Mapping::Auto);
    const auto expected = reference_radiance(compact_disc(), probe, colour::LightSpectra(), frames);
    const double without = test::relative_rms(lit(probe, 0, frames), expected);
    for (const int count : {4, 8, 16, 32}) {
        const double error = test::relative_rms(lit(probe, count, frames), expected);
        EXPECT_LT(error, without) << count;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Captured, ArcWithoutKeyLights,
    ::testing::Values(std::pair("beach", "beach_probe.hdr"), std::pair("blender_city", "blender_city.exr"),
                      std::pair("blender_studio", "blender_studio.exr"),
                      std::pair("blender_sunset", "blender_sunset.exr"), std::pair("ennis", "ennis_probulator.hdr"),
                      std::pair("grace", "grace_probe.hdr"), std::pair("pmndrs_studio", "pmndrs_studio.exr"),
                      std::pair("pmndrs_sunset", "pmndrs_sunset.exr"),
                      std::pair("royal_esplanade", "royal_esplanade_1k.hdr"),
                      std::pair("venice", "venice_sunset_256.hdr")),
    [](const auto& one) { return std::string(one.param.first); });

}  // namespace
}  // namespace rowland::diffraction
