#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "tests/evidence/section.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland::evidence {

namespace {

constexpr int kStops = 4;
/// A size at which pixels, which rungs differ in, take most of the time of gratings. In smaller pictures vertices do.
constexpr std::array kSize = {"640", "360"};

/// Pixels drawn by each representation against the time, as areas on top of one another.
Json area_plot(const std::vector<Json>& budgets) {
    std::set<std::string> names;
    double longest_ms = 0.0;
    for (const Json& budget : budgets) {
        longest_ms = std::max(longest_ms, budget["spent_ms"].get<double>());
        for (const auto& [name, part] : budget["pixels"].items()) names.insert(name);
    }
    Json series = Json::array();
    std::vector<double> low(budgets.size(), 0.0);
    for (const std::string& name : names) {
        Json points = Json::array();
        for (std::size_t i = 0; i < budgets.size(); ++i) {
            const double high = low[i] + budgets[i]["pixels"].value(name, 0.0);
            points.push_back({budgets[i]["spent_ms"], low[i], high});
            low[i] = high;
        }
        series.push_back({{"name", name}, {"kind", "area"}, {"points", points}});
    }
    return {{"caption", "The part of the gratings' pixels that each representation draws"},
            {"x", {{"label", "ms of a frame that gratings take"}, {"from", 0.0}, {"to", longest_ms}}},
            {"y", {{"label", "part of the pixels"}, {"from", 0.0}, {"to", 1.0}}},
            {"series", series}};
}

Json error_plot(const std::vector<Json>& budgets) {
    Json points = Json::array();
    double longest_ms = 0.0;
    double largest = 0.0;
    for (const Json& budget : budgets) {
        points.push_back({budget["spent_ms"], budget["error"]});
        longest_ms = std::max(longest_ms, budget["spent_ms"].get<double>());
        largest = std::max(largest, budget["error"].get<double>());
    }
    return {{"caption", "Error against time"},
            {"x", {{"label", "ms of a frame that gratings take"}, {"from", 0.0}, {"to", longest_ms}}},
            {"y", {{"label", "error, × what budgets ask for by default"}, {"from", 0.0}, {"to", largest}}},
            {"series", {{{"name", "budgets"}, {"kind", "line"}, {"points", points}}}}};
}

}  // namespace

Json level(const Inputs& /*inputs*/) {
    const std::filesystem::path programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "budgets.json";
    const test::Ended ended =
        test::run({(programs / "rowland-walk-benchmark").string(), "--frames", "0", "--stops", "0", "--budget-stops",
                   std::to_string(kStops), "--width", kSize[0], "--height", kSize[1], "--json", file.string()});
    if (ended.code != 0)
        fail_system("rowland-walk-benchmark", ended.err, "build the rooms and the program: ./rowland rooms --help");
    auto budgets = Json::parse(read_text_file(file, 1 << 20)).get<std::vector<Json>>();
    std::ranges::sort(budgets, std::ranges::less(),
                      [](const Json& budget) { return budget["spent_ms"].get<double>(); });
    Json rows = Json::array();
    Json figures;
    for (const Json& budget : budgets) {
        std::string pixels;
        for (const auto& [name, part] : budget["pixels"].items())
            if (part.get<double>() >= 0.005)
                pixels += fmt::format("{}{} {:.0f} %", pixels.empty() ? "" : ", ", name, 100.0 * part.get<double>());
        const auto name = fmt::format("{:.0f} %", 100.0 * budget["part"].get<double>());
        rows.push_back(
            {name, digits(budget["budget_ms"]), digits(budget["spent_ms"]), digits(budget["error"]), pixels});
        figures["level.spent_ms." + name] = budget["spent_ms"];
        figures["level.error." + name] = budget["error"];
    }
    return {
        {"title", "Three rooms within a budget"},
        {"text",
         {fmt::format(
             "A walk through the rooms of the demo (./rowland rooms, some 200 gratings), {} stops, {} × {} "
             "pixels: frames without a limit, and within parts of the time that these take. An error of 1 is what a "
             "material asks for by default; the frame control chooses for each object which of its "
             "measured ways to draw it the time allows.",
             kStops, kSize[0], kSize[1])}},
        {"tables",
         {{{"caption", "Means over the stops; each time is the median of 16 frames"},
           {"columns", {"budget", "budget (ms)", "taken (ms)", "error ×", "pixels drawn by"}},
           {"rows", rows}}}},
        {"plots", {error_plot(budgets), area_plot(budgets)}},
        {"figures", figures}};
}

}  // namespace rowland::evidence
