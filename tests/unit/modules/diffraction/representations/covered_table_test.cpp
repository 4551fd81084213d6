// Tables of covered gratings hold T(s_n); the caller multiplies with T(v_n) (PHYSICS §10).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "modules/diffraction/representations/arc/arc_table.h"
#include "modules/diffraction/representations/transfer/transfer_table.h"
#include "tests/support/test_data.h"
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
        const double transfer =
            error_of(bake(one.grating, TransferSettings{.grid = fine, .storage = Storage::Float}), one, views);
        const double exact =
            error_of(bake(one.grating, ArcSettings{.rank = 1000, .grid = fine, .storage = Storage::Float}), one, views);
        const double eight = error_of(bake(one.grating, ArcSettings{.rank = 8}), one, views);
        RecordProperty(one.name, fmt::format("{:.3g} {:.3g} {:.3g}", transfer, exact, eight));
        EXPECT_LT(transfer, 1e-4) << one.name;
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

}  // namespace
}  // namespace rowland::diffraction
