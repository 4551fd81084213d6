// Tables of covered gratings hold T(s_n); the caller multiplies with T(v_n) (PHYSICS §10).
// Tables of lattices over light as spherical harmonics.

#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/representations/arc/arc_table.h"
#include "modules/diffraction/representations/spikes/spikes.h"
#include "tests/support/files.h"
#include "tests/unit/modules/diffraction/reference/json_oracle.h"
#include "tests/unit/modules/diffraction/representations/baked_views.h"

namespace rowland::diffraction {
namespace {

template <typename Table>
double error_of(const Table& table, const test::JsonCase& one, const std::vector<test::TangentView>& views) {
    std::vector<glm::dvec3> xyz = test::evaluated(table, views);
    for (std::size_t i = 0; i < xyz.size(); ++i) xyz[i] *= transmittance(one.grating.cover, views[i].view.z);
    return test::relative_rms(xyz, one.xyz);
}

/// 1e-4 of the full rank; with a lobe, what a view table of 64 nodes loses (bare: the same). Rank 8: 3 %, as bare.
TEST(CoveredTables, MatchTheBandlimitedOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_cover.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    int cases = 0;
    for (const test::JsonCase& one : test::read_json_cases(path)) {
        if (one.light != "bandlimited_light_n5" || !is_flat(one.grating.lobe)) continue;
        const auto views = test::tangent_views(light, one.frames);
        const ViewGrid fine{.mapping = ViewMapping::OneDimensional, .columns = 1024, .rows = 1};
        const double exact =
            error_of(bake(one.grating, ArcSettings{.rank = 1000, .grid = fine, .storage = Storage::Float}), one, views);
        const double eight = error_of(bake(one.grating, ArcSettings{.rank = 8}), one, views);
        EXPECT_LT(exact, 1e-4) << one.name;
        EXPECT_LT(eight, 0.03) << one.name;
        ++cases;
    }
    EXPECT_EQ(cases, 2);
}

/// A cover of index 1 is none.
TEST(CoveredTables, AnIndexOfOneIsNoCover) {
    Grating grating{.pitch_nm = 1600.0, .profile = LamellarProfile{.duty = 0.35, .depth_nm = 130.0}};
    const ArcSettings settings{.bands = 3, .rank = 12, .storage = Storage::Float};
    const ArcTable bare = bake(grating, settings);
    grating.cover = Cover{.ior = 1.0};
    const ArcTable covered = bake(grating, settings);
    EXPECT_EQ(bare.terms, LightTerms::ArcMoments);
    EXPECT_EQ(covered.terms, LightTerms::Harmonics);
    lighting::ShLight light{.bands = 3, .coefficients = std::vector<glm::dvec3>(9, glm::dvec3(0.3, 0.2, 0.1))};
    light.coefficients[0] = glm::dvec3(3.0);
    // Either table's truncation at rank 12.
    for (const glm::dvec3 view : {glm::dvec3(0.1, 0.2, 0.97), glm::dvec3(-0.6, 0.3, 0.74)}) {
        const glm::dvec3 wanted = evaluate(bare, light, view);
        EXPECT_LT(glm::length(evaluate(covered, light, view) - wanted), 2e-3 * glm::length(wanted));
    }
}

using test::relative_rms;

Grating oblique_lattice() {
    Grating grating;
    grating.orders.clear();
    grating.pitch_nm = 900.0;
    grating.cover = Cover{.ior = 1.4};
    grating.lattice =
        Lattice{.a_nm = {900.0, 100.0},
                .b_nm = {-200.0, 1300.0},
                .profile = CrossedProfile{.along_a = BlazedProfile{250.0}, .along_b = SinusoidalProfile{120.0}},
                .orders = 2};
    return grating;
}

/// The light and the views of the oracle's cases under 5 bands.
struct BandLimitedCase {
    test::JsonCase expected;
    std::vector<test::TangentView> views;
};

std::vector<BandLimitedCase> band_limited_cases(const std::filesystem::path& path,
                                                const std::filesystem::path& light_path) {
    const lighting::ShLight light = test::read_sh_light(light_path);
    std::vector<BandLimitedCase> cases;
    for (test::JsonCase& one : test::read_json_cases(path))
        if (one.light == "bandlimited_light_n5") cases.push_back({one, test::tangent_views(light, one.frames)});
    return cases;
}

/// Without a table .04 %: an order ends at the horizon within a nanometre; .3 % where a screen's many points are
/// joined. With the default table of 64 × 32 views, what it loses between its nodes.
TEST(LatticeTables, MatchTheBandlimitedOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_lattice.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const std::vector<BandLimitedCase> cases = band_limited_cases(path, light_path);
    ASSERT_EQ(cases.size(), 3U);
    for (const BandLimitedCase& one : cases) {
        const Grating& grating = one.expected.grating;
        const auto error = [&](const std::vector<glm::dvec3>& xyz) { return relative_rms(xyz, one.expected.xyz); };
        const TransferTerms terms(grating, colour::LightSpectra(), 5);
        std::vector<glm::dvec3> exact;
        for (const test::TangentView& at : one.views) {
            exact.emplace_back(0.0);
            const std::vector<glm::dmat3> coefficients = terms.coefficients(at.view.x, at.view.y);
            for (std::size_t i = 0; i < coefficients.size(); ++i)
                exact.back() += coefficients[i] * at.light.coefficients[i];
        }
        const double sixteen = error(test::evaluated(bake(grating, ArcSettings{.rank = 16}), one.views));
        EXPECT_LT(error(exact), one.expected.grating.lattice->orders > 4 ? 4e-3 : 5e-4) << one.expected.name;
        EXPECT_LT(sixteen, 3e-2) << one.expected.name;
    }
}

/// Of many orders, whose points are joined: 2e-3 of the largest, what these lose where the horizon parts them.
TEST(LatticeTables, OfManyOrdersSumTheSpectraOfAll) {
    Grating screen = oblique_lattice();
    screen.lattice = Lattice{.a_nm = {40000.0, 0.0},
                             .b_nm = {9000.0, 50000.0},
                             .profile = ApertureProfile{.width_nm = 15000.0, .height_nm = 12000.0},
                             .orders = 5};
    Grating sheet = screen;
    sheet.cover.reset();
    sheet.transmission.emplace();
    for (const Grating& grating : {screen, sheet}) {
        const TransferTerms terms(grating, colour::LightSpectra(), 4);
        const ViewSpectrum spectrum(grating, 4);
        for (const glm::dvec2& view : {glm::dvec2(0.3, -0.4), glm::dvec2(-0.7, 0.6), glm::dvec2(0.0, 0.0)}) {
            const std::vector<glm::dmat3> found = terms.coefficients(view.x, view.y);
            const std::vector<double> by_nm = spectrum.coefficients(view.x, view.y);
            double largest = 0.0;
            double difference = 0.0;
            for (std::size_t i = 0; i < found.size(); ++i) {
                glm::dmat3 expected(0.0);
                for (std::size_t j = 0; j < kWavelengths; ++j)
                    expected += (j == 0 || j + 1 == kWavelengths ? 0.5 : 1.0) * by_nm[j * found.size() + i] *
                                observed_spectra(colour::LightSpectra(), colour::kVisibleMin + static_cast<double>(j));
                for (int c = 0; c < 3; ++c)
                    for (int o = 0; o < 3; ++o) {
                        largest = std::max(largest, std::abs(expected[c][o]));
                        difference = std::max(difference, std::abs(expected[c][o] - found[i][c][o]));
                    }
            }
            EXPECT_GT(largest, 0.01);
            EXPECT_LT(difference, 2e-3 * largest) << view.x;
        }
    }
}

/// Of a lattice without any symmetry, under a cover: every table against the reference. 2 % of 64 × 32 views; in
/// brackets what is lost besides, as of grooves.
TEST(LatticeTables, AreTheReferences) {
    const Grating grating = oblique_lattice();
    lighting::ShLight light{.bands = 4, .coefficients = {}};
    for (int i = 0; i < 16; ++i)
        light.coefficients.emplace_back(i == 0 ? 3.0 : std::sin(2.0 * i), i == 0 ? 3.0 : std::cos(1.3 * i),
                                        std::sin(i) + 1.0);
    std::vector<ShadingPoint> frames;
    for (int i = 0; i < 12; ++i)
        frames.push_back({.view = {std::sin(1.7 * i), std::cos(2.9 * i), 0.4 + 0.1 * i},
                          .normal = {0.2, 0.1, 1.0},
                          .grating = {1.0, std::sin(i), -0.2 - 0.1 * std::sin(i)}});
    const std::vector<glm::dvec3> expected =
        reference_radiance(grating, IncidentLight(light), colour::LightSpectra(), frames);
    const std::vector<test::TangentView> views = test::tangent_views(light, frames);
    const auto error = [&](const auto& table) {
        std::vector<glm::dvec3> xyz = test::evaluated(table, views);
        for (std::size_t i = 0; i < xyz.size(); ++i) xyz[i] *= transmittance(grating.cover, views[i].view.z);
        return relative_rms(xyz, expected);
    };
    EXPECT_LT(error(bake(grating, ArcSettings{.bands = 4, .rank = 1000, .storage = Storage::Float})), 2e-2);
    EXPECT_LT(error(bake(grating, ArcSettings{.bands = 4, .rank = 12})), 0.05);                       // (the rank)
    EXPECT_LT(error(bake(grating, SpikeTableSettings{.spikes = {.bands = 4, .spikes = 16}})), 0.03);  // (the spikes)
}

}  // namespace
}  // namespace rowland::diffraction
