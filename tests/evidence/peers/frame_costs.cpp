#include "tests/evidence/peers/frame_costs.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland::evidence {

namespace {

using nlohmann::json;

constexpr std::uint64_t kMostReportBytes = 1 << 20;
constexpr const char* kFrames =
    "plain,peer/*,direct/lights:1,direct/lights:16,planar,arc/bands:8/rank:12,arc/key-lights:16";
constexpr const char* kGeneration = "RDNA2";

std::filesystem::path program(const char* name) {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
}

}  // namespace

std::string FrameCosts::text(const std::map<std::string, double>& values, const std::string& name) {
    const auto found = values.find(name);
    return found == values.end() ? "–" : fmt::format("{:.2f}", found->second);
}

FrameCosts measure_frame_costs() {
    const test::TemporaryFolder folder;
    FrameCosts costs;
    const std::string times = (folder.path() / "times.json").string();
    const test::Ended benchmark = test::run({program("rowland-benchmark").string(), "--only", kFrames, "--width", "480",
                                             "--height", "270", "--rounds", "8", "--json", times},
                                            {.limit = std::chrono::minutes(5)});
    if (benchmark.code != 0) fail_system("rowland-benchmark", benchmark.err, "build rowland-benchmark");
    const json report = json::parse(read_text_file(times, kMostReportBytes));
    costs.renderer = report.at("gl_renderer");
    std::map<std::string, double> work_ms;
    for (const json& frame : report.at("frames")) work_ms[frame.at("name")] = frame.at("work_ms");
    for (const auto& [name, ms] : work_ms) costs.time[name] = ms / work_ms.at("plain");

    const std::filesystem::path compiler = program("rowland-gpu-cost");
    if (!std::filesystem::exists(compiler)) {
        costs.missing = "rowland-gpu-cost is not built: it needs Vulkan's headers";
        return costs;
    }
    const std::string cycles = (folder.path() / "cycles.json").string();
    const test::Ended ended =
        test::run({compiler.string(), "--only", kFrames, "--json", cycles}, {.limit = std::chrono::minutes(5)});
    if (ended.code != 0) {
        costs.missing = "rowland-gpu-cost failed: " + ended.err;
        return costs;
    }
    for (const json& generation : json::parse(read_text_file(cycles, kMostReportBytes))) {
        if (generation.at("name") != kGeneration) continue;
        costs.gpu = generation.at("device").get<std::string>() + ", " + generation.at("driver").get<std::string>();
        for (const auto& [name, stages] : generation.at("frames").items())
            costs.cycles[name] = stages.at("fragment").at("times_plain");
    }
    return costs;
}

}  // namespace rowland::evidence
