#include "editor/trade/report.h"

#include <gmock/gmock.h>

#include <random>
#include <regex>

#include "editor/trade/paper_figures.h"
#include "tests/support/files.h"

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

TEST(Report, SaysWhatTheTheoryIsOffWhereItIsKnown) {
    const auto data =
        report_data(results(), {}, {}, {},
                    {.date = "", .command = "", .theories = {{0, 0, "sphere", 0.4}, {0, 0, "picture", 0.3}}});
    EXPECT_EQ(data["panels"][0]["theory_error"], 0.3);
    EXPECT_TRUE(report_data(results(), {}, {}, {}, {})["panels"][0]["theory_error"].is_null());
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
    EXPECT_TRUE(std::regex_match(data["version"].get<std::string>(), std::regex("[0-9.]+, [0-9a-f]{8}")));
    EXPECT_EQ(data["probes"][0]["name"], "sky");
    EXPECT_EQ(data["probes"][0]["brightest_fraction"], 0.25);
    EXPECT_EQ(data["films"][0]["probe"], "sky");
    EXPECT_EQ(data["films"][0]["relative_rms"], 0.01);
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
    EXPECT_EQ(material_of(R"({"grating": {"pitch_nm": 900, "profile": {"type": "sinusoidal", "depth_nm": 150}},
                             "metal": "Al"})")["grating"]["theory"],
              "rigorous");
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

TEST(ParetoFront, TakesTheFirstOfEqualPointsAndNoneThatIsNotFinite) {
    const double infinite = std::numeric_limits<double>::infinity();
    const std::vector<TradePoint> points = {{infinite, 0.1}, {1.0, 2.0}, {1.0, 2.0}, {0.5, std::nan("")}};
    EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1}));
    EXPECT_TRUE(pareto_front({}).empty());
}

/// Against its definition, pair by pair.
TEST(ParetoFront, AgreesWithItsDefinition) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> value(0, 9);
    std::vector<TradePoint> points;
    for (int i = 0; i < 60; ++i) points.push_back({1.0 * value(random), 1.0 * value(random)});
    std::vector<bool> on_front(points.size(), false);
    for (const std::size_t i : pareto_front(points)) on_front[i] = true;
    for (std::size_t i = 0; i < points.size(); ++i) {
        bool beaten = false;
        for (std::size_t j = 0; j < points.size(); ++j) {
            const bool no_worse = points[j].cost <= points[i].cost && points[j].error <= points[i].error;
            const bool better = points[j].cost < points[i].cost || points[j].error < points[i].error;
            beaten = beaten || (no_worse && (better || j < i));
        }
        EXPECT_EQ(on_front[i], !beaten) << i;
    }
}

lighting::ProbeImage uniform_but(std::size_t texel, float value) {
    image::Image image{.width = 64, .height = 32, .texels = std::vector<glm::vec3>(2048, glm::vec3(0.5F))};
    image.texels[texel] = glm::vec3(value);
    return {std::move(image), lighting::Mapping::Equirectangular};
}

TEST(ProbeStatistics, OfAUniformProbe) {
    const ProbeStatistics found = statistics_of(uniform_but(0, 0.5F));
    EXPECT_EQ(found.width, 64);
    EXPECT_EQ(found.height, 32);
    EXPECT_NEAR(found.mean, 0.5, 1e-6);
    EXPECT_NEAR(found.peak_over_mean, 1.0, 1e-6);
    EXPECT_NEAR(found.brightest_fraction, 1e-3, 1e-8);
}

TEST(ProbeStatistics, ALampOfATexel) {
    // A texel at the equator: 2π/64 · π/32 sr of 4π, but for 4e-4: .0767 % of the sphere, which gives .0767 of .5767.
    const ProbeStatistics found = statistics_of(uniform_but(16 * 64 + 20, 50.0F));
    EXPECT_NEAR(found.mean, 0.5 + 49.5 * 7.666e-4, 1e-4);
    EXPECT_NEAR(found.peak_over_mean, 50.0 / found.mean, 1e-6);
    EXPECT_NEAR(found.brightest_fraction, (50.0 * 7.666e-4 + 0.5 * 2.334e-4) / found.mean, 1e-4);
}

TEST(ProbeStatistics, OfABlackProbe) {
    image::Image image{.width = 8, .height = 4, .texels = std::vector<glm::vec3>(32, glm::vec3(0.0F))};
    const ProbeStatistics found = statistics_of({std::move(image), lighting::Mapping::Equirectangular});
    EXPECT_EQ(found.mean, 0.0);
    EXPECT_EQ(found.peak_over_mean, 0.0);
}

diffraction::Grating slit(double grooves) {
    return {.pitch_nm = 1600.0, .grooves = grooves, .profile = diffraction::SlitProfile{.width_nm = 800.0}};
}

/// Goodman: a peak of N grooves is 0.886/N of an order wide at half its height; an order of 550 nm at 1600 nm is
/// (550/1600)/cos θ radians, θ = 20.1°.
TEST(PaperFigures, ThePeakHasItsTrueWidth) {
    const Figure2 figure = figure_2(slit(1500.0));
    const double order = 550.0 / 1600.0 / std::cos(std::asin(550.0 / 1600.0)) * 180.0 / std::numbers::pi;
    EXPECT_NEAR(figure.peak_width_degrees, 0.8859 / 1500.0 * order, 1e-3 * figure.peak_width_degrees);
    EXPECT_NEAR(figure_2(slit(150.0)).peak_width_degrees, 10.0 * figure.peak_width_degrees,
                1e-3 * figure.peak_width_degrees);
}

TEST(PaperFigures, DiffractionIsSpikesWhereInterferenceIsSmooth) {
    const Figure2 figure = figure_2(slit(1500.0));
    const auto fraction_above = [](const Curve& curve) {
        return static_cast<double>(std::count_if(curve.y.begin(), curve.y.end(), [](double y) { return y > 0.3; })) /
               static_cast<double>(curve.y.size());
    };
    EXPECT_LT(fraction_above(figure.diffraction), 0.01);
    EXPECT_GT(fraction_above(figure.interference), 0.4);
    EXPECT_EQ(*std::max_element(figure.diffraction.y.begin(), figure.diffraction.y.end()), 1.0);
    // The slit's envelope at order ±1: sinc²(½) = (2/π)².
    EXPECT_NEAR(figure.diffraction.y.front(), std::pow(2.0 / std::numbers::pi, 2.0), 1e-12);
    EXPECT_NEAR(figure.diffraction.x.back(), std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace rowland::trade
