// The figures of the page: what is claimed of the models holds, and does not where a model is disturbed.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/evidence/curves.h"
#include "tests/evidence/metals.h"
#include "tests/evidence/section.h"
#include "tests/support/files.h"
#include "tests/support/folder_test.h"
#include "tests/support/program.h"

namespace rowland::evidence {
namespace {

/// Largest RMS error of a preset against its manufacturer's curve.
constexpr double kCurveLimit = 0.06;

double curve_error(const std::filesystem::path& folder, const RuledGrating& ruled, double depth_factor,
                   double CurvePoint::*model) {
    diffraction::Grating grating = ruled.grating;
    std::get<diffraction::BlazedProfile>(grating.profile).depth_nm *= depth_factor;
    return curve_rms(compare_curve(folder / ruled.curve, grating, ruled.name == "ruled_1200" ? 4 : 1), model);
}

TEST(Evidence, PresetsFollowTheManufacturersCurves) {
    ROWLAND_TEST_DATA(readme, "data/measured/README.md");
    const std::vector<RuledGrating> gratings = ruled_gratings();
    ASSERT_GE(gratings.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        SCOPED_TRACE(gratings[i].name);
        EXPECT_LT(curve_error(readme.parent_path(), gratings[i], 1.0, &CurvePoint::rigorous), kCurveLimit);
        EXPECT_GT(curve_error(readme.parent_path(), gratings[i], 1.0, &CurvePoint::scalar), kCurveLimit);
        // A tenth of the depth more or less is another grating.
        EXPECT_GT(curve_error(readme.parent_path(), gratings[i], 0.88, &CurvePoint::rigorous), kCurveLimit);
        EXPECT_GT(curve_error(readme.parent_path(), gratings[i], 1.12, &CurvePoint::rigorous), kCurveLimit);
    }
}

TEST(Evidence, PitSequencesAreDrawnAndAreNoSinglePits) {
    ROWLAND_TEST_DATA(ennis, "probes/ennis_probulator.hdr");
    const Json figures = pit_sequence({.data = ennis.parent_path().parent_path()})["figures"];
    for (const char* probe : {"venice sunset", "ennis"}) {
        SCOPED_TRACE(probe);
        const auto figure = [&](const std::string& name) {
            return figures["pit_sequence." + name + "." + probe].get<double>();
        };
        EXPECT_LT(figure("planar_error"), 0.015);
        // Single pits would be noticed.
        EXPECT_GT(figure("change"), 0.03);
        EXPECT_GT(figure("change"), 4.0 * figure("planar_error"));
    }
}

TEST(Evidence, ReflectanceIsThatOfTheTablesIndices) {
    const IndexTable table{.metal = colour::Metal::Ag,
                           .author = "nobody",
                           .wavelengths_nm = {500.0, 600.0},
                           .n = {2.0, 4.0},
                           .k = {1.0, 3.0}};
    EXPECT_NEAR(reflectance(table, 500.0), 2.0 / 10.0, 1e-15);
    EXPECT_NEAR(reflectance(table, 550.0), 8.0 / 20.0, 1e-15);
    EXPECT_NEAR(reflectance(table, 400.0), 2.0 / 10.0, 1e-15);
    EXPECT_NEAR(reflectance(table, 700.0), 18.0 / 34.0, 1e-15);
}

TEST(Evidence, MetalsInUseAreThoseThatAuthorsMeasured) {
    const auto tables = read_index_tables(test::source_path("tests/evidence/data/metals"));
    for (const IndexTable& table : tables)
        for (const std::string& name : colour::metal_names()) {
            const colour::Metal other = *colour::parse_metal(name);
            double squares = 0.0;
            int count = 0;
            for (double wavelength_nm = 420.0; wavelength_nm <= 700.0; wavelength_nm += 20.0, ++count)
                squares +=
                    std::pow(reflectance(table, wavelength_nm) - colour::metal_reflectance(other, wavelength_nm), 2);
            const double rms = std::sqrt(squares / count);
            // Silver's is the largest: .04. Aluminium and silver differ by as much.
            if (other == table.metal) {
                EXPECT_LT(rms, 0.06) << table.author << " of " << name;
            } else if (name == "Au" || name == "Cu") {
                EXPECT_GT(rms, 0.06) << table.author << " against " << name;
            }
        }
    EXPECT_GE(tables.size(), 12U);
}

using EvidenceProgram = test::FolderTest;

TEST_F(EvidenceProgram, WritesOnePageWithWhatItMeasured) {
    const test::Ended ended = test::run({ROWLAND_EVIDENCE, "--only", "metals", "--json", path("figures.json").string(),
                                         "-o", path("page.html").string()});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const Json measured = Json::parse(text("figures.json"));
    ASSERT_EQ(measured.size(), 1U);
    EXPECT_EQ(measured[0]["name"], "metals");
    EXPECT_GT(measured[0]["figures"]["metals.error_bar.Ag"].get<double>(), 0.0);
    EXPECT_THAT(text("page.html"), testing::HasSubstr("Johnson 1972"));
}

TEST_F(EvidenceProgram, RefusesAnUnknownSectionAndAFolderWithoutData) {
    EXPECT_EQ(test::run({ROWLAND_EVIDENCE, "--only", "curve"}).code, 2);
    const test::Ended ended = test::run(
        {ROWLAND_EVIDENCE, "--only", "curves", "--data", path("none").string(), "-o", path("page.html").string()});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, testing::HasSubstr("B600_G5303.csv"));
    EXPECT_FALSE(std::filesystem::exists(path("page.html")));
}

}  // namespace
}  // namespace rowland::evidence
