#include "tests/gpu_cost/cost_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"

namespace rowland::gpu_cost {

namespace {

constexpr double kMostGrowth = 0.05;  ///< a change of the compiler's schedule alone moves ratios by 1 to 2 %

const FrameCost* find(const std::vector<FrameCost>& frames, const std::string& name) {
    const auto found = std::find_if(frames.begin(), frames.end(), [&](const FrameCost& f) { return f.name == name; });
    return found == frames.end() ? nullptr : &*found;
}

std::string stage_text(const StageCost& cost) {
    const StageStatistics& s = cost.statistics;
    return fmt::format("{:7.2f} {:7.0f} {:6} {:5} {:5} {:5}", cost.times_plain, s.inverse_throughput, s.instructions,
                       s.fetches, s.vector_registers, s.waves);
}

nlohmann::ordered_json to_json(const StageCost& cost) {
    const StageStatistics& s = cost.statistics;
    return {{"times_plain", std::round(1000.0 * cost.times_plain) / 1000.0},
            {"inverse_throughput", s.inverse_throughput},
            {"instructions", s.instructions},
            {"fetches", s.fetches},
            {"vector_registers", s.vector_registers},
            {"waves", s.waves}};
}

/// Adds a line if a stage's ratio has grown.
void compare(const std::string& what, const StageCost& cost, const nlohmann::json& held, Comparison& result) {
    const double before = held.at("times_plain");
    if (!(cost.times_plain <= (1.0 + kMostGrowth) * before))
        result.grown.push_back(fmt::format("{}: {:.3f} × plain, was {:.3f}", what, cost.times_plain, before));
}

void compare(const GenerationCost& cost, const nlohmann::json& held, Comparison& result) {
    if (cost.driver != held.at("driver").get<std::string>()) {
        result.same_driver = false;
        return;
    }
    for (const auto& [name, stages] : held.at("frames").items()) {
        const std::string what = cost.name + ", " + name;
        const FrameCost* frame = find(cost.frames, name);
        if (frame == nullptr) {
            result.grown.push_back(what + ": not measured");
            continue;
        }
        compare(what + ", fragment stage", frame->fragment, stages.at("fragment"), result);
        compare(what + ", vertex stage", frame->vertex, stages.at("vertex"), result);
    }
}

}  // namespace

void divide_by_plain(GenerationCost& cost) {
    const FrameCost* plain = find(cost.frames, "plain");
    if (plain == nullptr) fail_system("rowland-benchmark", "no frame 'plain'");
    const double fragment = plain->fragment.statistics.inverse_throughput;
    const double vertex = plain->vertex.statistics.inverse_throughput;
    for (FrameCost& frame : cost.frames) {
        frame.fragment.times_plain = frame.fragment.statistics.inverse_throughput / fragment;
        frame.vertex.times_plain = frame.vertex.statistics.inverse_throughput / vertex;
    }
}

std::string to_text(const GenerationCost& cost) {
    std::size_t width = 0;
    for (const FrameCost& frame : cost.frames) width = std::max(width, frame.name.size());
    std::string text = fmt::format("{} ({}, {})\n", cost.name, cost.device, cost.driver);
    text += fmt::format("{:{}}   fragment stage                             | vertex stage\n", "", width);
    constexpr const char* columns = "× plain  cycles  instr fetch VGPRs waves";
    text += fmt::format("{:{}}   {}  |  {}\n", "frame", width, columns, columns);
    for (const FrameCost& frame : cost.frames)
        text +=
            fmt::format("{:{}}   {}  |  {}\n", frame.name, width, stage_text(frame.fragment), stage_text(frame.vertex));
    return text;
}

std::string to_json(const std::vector<GenerationCost>& costs) {
    std::string text = "[";
    for (const GenerationCost& cost : costs) {
        text += fmt::format("{}\n{{\"name\": {}, \"device\": {}, \"driver\": {}, \"frames\": {{",
                            text.size() > 1 ? "," : "", nlohmann::json(cost.name).dump(),
                            nlohmann::json(cost.device).dump(), nlohmann::json(cost.driver).dump());
        for (const FrameCost& frame : cost.frames) {
            const nlohmann::ordered_json stages = {{"fragment", to_json(frame.fragment)},
                                                   {"vertex", to_json(frame.vertex)}};
            text += fmt::format("{}\n{}: {}", &frame == cost.frames.data() ? "" : ",",
                                nlohmann::json(frame.name).dump(), stages.dump());
        }
        text += "}}";
    }
    return text + "]\n";
}

Comparison compare_with(const std::string& held, const std::string& file, const std::vector<GenerationCost>& costs) {
    Comparison result;
    try {
        for (const nlohmann::json& generation : nlohmann::json::parse(held))
            for (const GenerationCost& cost : costs)
                if (cost.name == generation.at("name").get<std::string>()) compare(cost, generation, result);
    } catch (const nlohmann::json::exception& error) {
        refuse_input(file, "", error.what(), "a file that --json wrote");
    }
    return result;
}

}  // namespace rowland::gpu_cost
