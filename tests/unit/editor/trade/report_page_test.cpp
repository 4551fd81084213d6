// The report as a browser draws it: numbers read off the charts' own axes.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/unit/editor/trade/trade_run.h"

namespace rowland {
namespace {

using ::testing::HasSubstr;

std::string browser() {
    for (const char* path : {"/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"})
        if (std::filesystem::exists(path)) return path;
    return {};
}

/// The document after its scripts have run.
std::string drawn(const std::string& chromium, const std::filesystem::path& page,
                  const std::filesystem::path& profile) {
    return test::run({chromium, "--headless", "--no-sandbox", "--disable-gpu", "--user-data-dir=" + profile.string(),
                      "--virtual-time-budget=8000", "--dump-dom", "file://" + page.string()})
        .out;
}

std::string attribute(const std::string& element, const std::string& name) {
    const std::size_t begin = element.find(" " + name + "=\"");
    if (begin == std::string::npos) return {};
    const std::size_t value = begin + name.size() + 3;
    return element.substr(value, element.find('"', value) - value);
}

/// All elements of a kind, from their opening to before the next tag.
std::vector<std::string> elements(const std::string& text, const std::string& tag) {
    std::vector<std::string> result;
    for (std::size_t at = 0; (at = text.find("<" + tag + " ", at)) != std::string::npos; ++at)
        result.push_back(text.substr(at, text.find('<', at + 1) - at));
    return result;
}

std::string part(const std::string& text, const std::string& from, const std::string& to) {
    const std::size_t begin = text.find(from);
    if (begin == std::string::npos) return {};
    return text.substr(begin, text.find(to, begin) - begin);
}

/// A logarithmic axis, as its tick labels tell it.
struct Axis {
    double position_1 = 0.0;  ///< of the first tick
    double position_2 = 0.0;  ///< of the last
    double value_1 = 0.0;
    double value_2 = 0.0;

    double value(double position) const {
        return value_1 * std::pow(value_2 / value_1, (position - position_1) / (position_2 - position_1));
    }
};

Axis read_axis(const std::string& chart, const std::string& name, const std::string& coordinate) {
    const auto labels = elements(part(chart, "class=\"axis-" + name + "\"", "</g>"), "text");
    EXPECT_GE(labels.size(), 2U) << name;
    if (labels.size() < 2) return {};
    const auto text = [](const std::string& label) { return std::stod(label.substr(label.find('>') + 1)); };
    const double shift = name == "y" ? -4.0 : 0.0;  // labels stand below their line
    return {std::stod(attribute(labels.front(), coordinate)) + shift,
            std::stod(attribute(labels.back(), coordinate)) + shift, text(labels.front()), text(labels.back())};
}

class ReportPage : public ::testing::Test {
 protected:
    void SetUp() override {
        chromium_ = browser();
        if (chromium_.empty()) GTEST_SKIP() << "no chromium";
        test::write_sweep_inputs(folder_.path());
        write_file_atomic(folder_.path() / "cd.json", R"({"grating": {"pitch_nm": 1600, "profile": {"type": "lamellar",
            "duty": 0.35, "depth_nm": 120}, "theory": "scalar"}, "metal": "Al"})");
    }
    std::string report(const std::string& arguments) {
        const auto run = test::run_trade(folder_.path(), "report " + arguments + " " + test::small_sweep());
        EXPECT_EQ(run.code, 0) << run.err;
        return drawn(chromium_, folder_.path() / "results" / "report.html", folder_.path() / "profile");
    }
    std::vector<test::Row> rows() const { return test::read_rows(folder_.path() / "results" / "sweep.csv"); }

    std::string chromium_;
    test::TemporaryFolder folder_;
};

/// Points of the chart, by setting, against the CSV's numbers. Coordinates are written to a thousandth of a pixel of
/// about 450 over one to three decades: 2e-5 relative; tick labels have three digits and are exact.
void expect_points(const std::string& page, const std::vector<test::Row>& rows, const std::string& set,
                   const std::string& cost, const std::function<double(const test::Row&)>& cost_of) {
    const std::string chart = part(page, fmt::format("data-chart=\"cd sky {} {}\"", set, cost), "</svg>");
    ASSERT_FALSE(chart.empty()) << set;
    const Axis x = read_axis(chart, "x", "x");
    const Axis y = read_axis(chart, "y", "y");
    int found = 0;
    for (const std::string& point : elements(chart, "circle"))
        for (const test::Row& row : rows)
            if (row.at("set") == set && row.at("setting") == attribute(point, "data-setting")) {
                EXPECT_NEAR(x.value(std::stod(attribute(point, "cx"))) / cost_of(row), 1.0, 1e-4) << row.at("setting");
                EXPECT_NEAR(y.value(std::stod(attribute(point, "cy"))) / (100.0 * std::stod(row.at("relative_rms"))),
                            1.0, 1e-4)
                    << row.at("setting");
                ++found;
            }
    const auto shown = std::count_if(rows.begin(), rows.end(),
                                     [&](const test::Row& row) { return row.at("set") == set && cost_of(row) > 0.0; });
    EXPECT_EQ(found, shown);
    EXPECT_GE(found, 2);
}

TEST_F(ReportPage, ChartsShowTheTablesNumbers) {
    const std::string page = report("--frame-size 64 36 --setting direct/key_lights=2");
    const auto measured = rows();
    EXPECT_THAT(part(page, "<section id=\"films\">", "</section>"), HasSubstr(">spherical harmonics, 3 bands</td>"));
    for (const char* set : {"tilted_cd", "sphere", "picture"}) {
        expect_points(page, measured, set, "frame_ratio",
                      [](const test::Row& row) { return std::stod(row.at("frame_ratio")); });
        expect_points(page, measured, set, "memory", [](const test::Row& row) {
            return (std::stod(row.at("table_bytes")) + 25000.0 * std::stod(row.at("vertex_bytes"))) / 1e6;
        });
    }
    EXPECT_NE(page.find("<a href=\"http://127.0.0.1:8080/#representation=direct&amp;material=%7B%22"),
              std::string::npos);
    // The theory's own error, measured: 9.25 % on the disc, 50.2 % on the sphere.
    const auto theory_error = [&](const char* set) {
        const std::string text = part(page, fmt::format("<h3>Points: {}", set), "%.</p>");
        return std::stod(text.substr(text.rfind(' ', text.size() - 2)));
    };
    EXPECT_NEAR(theory_error("tilted_cd"), 9.25, 0.3);
    EXPECT_NEAR(theory_error("sphere"), 50.2, 1.0);
    // Fig. 3 falls with the number of lights for the loop, and not for SH.
    const std::string figure_3 = part(page, "data-chart=\"figure 3\"", "</svg>");
    const Axis y = read_axis(figure_3, "y", "y");
    std::vector<double> loop;
    for (const std::string& dot : elements(figure_3, "circle"))
        if (attribute(dot, "data-series") == "each light and order on its own")
            loop.push_back(y.value(std::stod(attribute(dot, "cy"))));
    ASSERT_EQ(loop.size(), 10U);
    EXPECT_LT(loop.back(), 0.5 * loop.front());
    EXPECT_THAT(page, HasSubstr("direct, 6 lights"));
    EXPECT_EQ(elements(page, "img").size(), 4U + 2U);
}

}  // namespace
}  // namespace rowland
