#include "editor/trade/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/file.h"
#include "tests/support/temporary_folder.h"

namespace rowland::trade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

SweepResults results() {
    SweepResults r{.materials = {"cd"},
                   .probes = {"sky"},
                   .settings = {{diffraction::parse_method("spikes"), diffraction::parse_method("planar"),
                                 diffraction::parse_method("circle")}},
                   .errors = {},
                   .costs = {},
                   .device = "a device"};
    const double errors[] = {0.5, 0.02, 0.04};
    const double ms[] = {20.0, 12.0, 50.0};
    for (std::size_t s = 0; s < 3; ++s) {
        r.errors.push_back({0, 0, "picture", s, {.relative_rms = errors[s]}});
        r.costs.push_back({.material = 0,
                           .setting = s,
                           .cost = {.table_bytes = 1000 * (s + 1)},
                           .time = FrameTime{.ms = ms[s], .plain_ms = 10.0}});
    }
    return r;
}

TEST(Report, MarksTheFronts) {
    const auto data = report_data(results(), {}, {}, {}, {});
    const auto& rows = data["panels"][0]["rows"];
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_FALSE(rows[0].contains("front_speed"));
    EXPECT_TRUE(rows[1].contains("front_speed"));
    EXPECT_FALSE(rows[2].contains("front_speed"));
    EXPECT_TRUE(rows[0].contains("front_memory"));
    EXPECT_EQ(rows[1]["frame_ratio"], 1.2);
    EXPECT_EQ(rows[2]["memory"], 3000);
}

TEST(Report, FiguresFollowTheMeasurements) {
    SweepResults changed = results();
    changed.errors[1].error.relative_rms = 0.9;
    const auto data = report_data(changed, {}, {}, {}, {});
    EXPECT_EQ(data["panels"][0]["rows"][1]["relative_rms"], 0.9);
    EXPECT_TRUE(data["panels"][0]["rows"][2].contains("front_speed"));
}

TEST(Report, PicturesTheBestInRealTimeAndTheFirst) {
    EXPECT_EQ(pictured_settings(results(), 0, 0), (std::vector<std::size_t>{1, 0}));
    SweepResults slow = results();
    slow.costs[1].time->ms = 100.0;
    EXPECT_EQ(pictured_settings(slow, 0, 0), (std::vector<std::size_t>{0}));
}

TEST(Report, SaysHowItWasMadeAndUnderWhatLight) {
    const auto data = report_data(
        results(), {}, {}, {},
        {.date = "2026-01-02T03:04:05Z",
         .command = "rowland-trade report",
         .probes = {{.width = 64, .height = 32, .mean = 0.5, .peak_over_mean = 9.0, .brightest_fraction = 0.25}},
         .films = {{{.film = "soap", .roughness = 0.2, .method = "table", .relative_rms = 0.01, .fetches = 3}}}});
    EXPECT_EQ(data["date"], "2026-01-02T03:04:05Z");
    EXPECT_EQ(data["command"], "rowland-trade report");
    EXPECT_THAT(data["version"].get<std::string>(), testing::MatchesRegex("[0-9.]+, [0-9a-f]{8}"));
    EXPECT_EQ(data["probes"][0]["name"], "sky");
    EXPECT_EQ(data["probes"][0]["brightest_fraction"], 0.25);
    EXPECT_EQ(data["films"][0]["probe"], "sky");
    EXPECT_EQ(data["films"][0]["relative_rms"], 0.01);
}

TEST(Report, SaysThatTheMachineWasLoaded) {
    SweepResults r = results();
    r.costs[0].time->other_load = 0.02;
    EXPECT_EQ(report_data(r, {}, {}, {}, {})["loaded_times"], 0);
    r.costs[1].time->other_load = 0.4;
    r.costs[1].time->spread = 0.3;
    const auto data = report_data(r, {}, {}, {}, {});
    EXPECT_EQ(data["loaded_times"], 1);
    EXPECT_EQ(data["panels"][0]["rows"][1]["frame_spread"], 0.3);
    EXPECT_TRUE(data["panels"][0]["rows"][0]["frame_spread"].is_null());
}

TEST(Report, MarksThePapersSetting) {
    SweepResults r = results();
    r.settings[0][2] = diffraction::parse_method("spikes/spikes=4/bands=5");
    const auto data = report_data(r, {}, {}, {}, {});
    EXPECT_FALSE(data["panels"][0]["rows"][1].contains("paper"));
    EXPECT_TRUE(data["panels"][0]["rows"][2].contains("paper"));
}

/// Where it names no other file, which a page in a browser could not read.
TEST(Report, HoldsTheMaterialForThePageInABrowser) {
    const test::TemporaryFolder folder;
    const auto material_of = [&](const char* text) {
        write_file_atomic(folder.path() / "cd.json", std::string_view(text));
        SweepInputs inputs;
        inputs.materials = {folder.path() / "cd.json"};
        return report_data(results(), inputs, {}, {}, {})["panels"][0]["browser_material"];
    };
    EXPECT_EQ(
        material_of(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}},
                              "quality": {"representation": "direct"}})"),
        nlohmann::json::parse(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}}})"));
    write_file_atomic(folder.path() / "t.csv", std::string_view("wavelength_nm,R-1,R+1\n380,0.1,0.1\n780,0.1,0.1\n"));
    EXPECT_TRUE(
        material_of(
            R"({"grating": {"pitch_nm": 1600, "profile": {"type": "table", "file": "t.csv"}, "orders": [-1, 1]}})")
            .is_null());
}

TEST(Report, IsOneFileAndItsDataCannotEndTheScript) {
    SweepResults hostile = results();
    hostile.probes = {"</script><script>alert(1)</script>"};
    const std::string page = report_html(report_data(hostile, {}, {}, {}, {}));
    EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
    EXPECT_THAT(page, HasSubstr("\\u003c/script>"));
    EXPECT_THAT(page, Not(HasSubstr("/*DATA*/")));
    for (const char* foreign : {"src=\"http", "href=\"http", "@import", "fetch("})
        EXPECT_THAT(page, Not(HasSubstr(foreign)));
}

}  // namespace
}  // namespace rowland::trade
