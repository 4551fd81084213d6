#include "tests/gpu_cost/captured_frames.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "tests/support/program.h"

namespace rowland::gpu_cost {

namespace {

constexpr std::uint64_t kMostCapturedBytes = 1 << 24;

std::filesystem::path benchmark_program() {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "rowland-benchmark";
}

}  // namespace

void capture_programs(const std::filesystem::path& folder, const std::vector<std::string>& patterns) {
    test::Command command{
        benchmark_program(), "--programs", folder.string(), "--width", "64", "--height", "36",
    };
    if (!patterns.empty()) command.insert(command.end(), {"--only", fmt::format("{}", fmt::join(patterns, ","))});
    const test::Ended ended = test::run(command, {.limit = std::chrono::minutes(20)});
    if (ended.code == 2)
        refuse_input("--only", "", fmt::format("{}", fmt::join(patterns, ",")),
                     "names of frames, or patterns such as 'arc*'", "rowland-benchmark --list prints the names");
    if (ended.code != 0) fail_system("rowland-benchmark", ended.err, "build rowland-benchmark and rowland-cooked");
}

std::vector<CapturedFrame> read_frames(const std::filesystem::path& folder) {
    const auto json = nlohmann::json::parse(read_text_file(folder / "programs.json", kMostCapturedBytes));
    std::vector<CapturedFrame> frames;
    std::set<std::pair<std::string, std::map<std::string, int>>> known;
    for (const nlohmann::json& frame : json.at("frames")) {
        const std::string program = frame.at("program");
        std::map<std::string, int> lengths = frame.at("lengths");
        if (!known.insert({program, lengths}).second) continue;
        frames.push_back({.name = frame.at("name"),
                          .text = {read_text_file(folder / (program + ".vert"), kMostCapturedBytes),
                                   read_text_file(folder / (program + ".frag"), kMostCapturedBytes)},
                          .lengths = std::move(lengths)});
    }
    return frames;
}

}  // namespace rowland::gpu_cost
