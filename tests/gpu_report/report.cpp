#include "tests/gpu_report/report.h"

#include <fmt/format.h>

#include <algorithm>

namespace rowland::gpu_report {

namespace {

using nlohmann::json;

const json* find(const json& list, const std::string& name) {
    for (const json& one : list)
        if (one.at("name") == name) return &one;
    return nullptr;
}

std::string milliseconds(const json& time) {
    return time.is_number() ? fmt::format("{:.3f}", time.get<double>()) : "–";
}

std::string size_name(const TimedSize& size) {
    return fmt::format("{}×{}", size.frames.at("width").get<int>(), size.frames.at("height").get<int>());
}

std::string table_head(const std::string& first, const std::vector<std::string>& columns) {
    std::string head = "| " + first + " |";
    std::string rule = "\n| --- |";
    for (const std::string& column : columns) {
        head += " " + column + " |";
        rule += " --- |";
    }
    return head + rule + "\n";
}

std::string machine(const Report& report) {
    const json& frames = report.sizes.front().frames;
    return fmt::format("# Rowland on {}\n\n{}, OpenGL {}; {}; sources {}\n",
                       frames.at("gl_renderer").get<std::string>(), frames.at("gl_vendor").get<std::string>(),
                       frames.at("gl_version").get<std::string>(), frames.at("processor").get<std::string>(),
                       report.revision);
}

std::string test_row(const TestResults& results) {
    if (results.ended_early) return fmt::format("| {} | ended without results | | | |\n", results.program);
    return fmt::format("| {} | {} | {} | {} | {} |\n", results.program, results.passed, results.failed.size(),
                       results.skipped,
                       results.largest_difference ? fmt::format("{:.1e}", *results.largest_difference) : "–");
}

std::string tests(const Report& report) {
    std::string text = "\n## Tests\n" + table_head("program", {"passed", "failed", "skipped", "largest difference*"});
    for (const TestResults& results : report.tests) text += test_row(results);
    text += "\n\\* between a picture that passed and the CPU's, over its brightest component\n";
    for (const TestResults& results : report.tests)
        for (const FailedTest& failed : results.failed)
            text += fmt::format("- failed: `{}`: {}\n", failed.name, failed.worst);
    return text;
}

/// A row for each pass of the flight, a column for each size.
std::string passes(const Report& report) {
    std::vector<std::string> columns;
    std::string whole = "| whole frame, until it is done |";
    std::string ratio = "| × the frame without gratings |";
    for (const TimedSize& size : report.sizes) {
        columns.push_back(size_name(size));
        whole += " " + milliseconds(size.flight.at("frame").at("p50_ms")) + " |";
        ratio += fmt::format(" {:.2f} |", size.flight.at("times_plain").get<double>());
    }
    std::string text = "\n## Milliseconds per pass\nMedians of the GPU's time in a flight through the cabinet.\n\n";
    text += table_head("pass", columns);
    for (const json& pass : report.sizes.front().flight.at("passes")) {
        text += "| " + pass.at("name").get<std::string>() + " |";
        for (const TimedSize& size : report.sizes) {
            const json* same = find(size.flight.at("passes"), pass.at("name"));
            const bool timed = same != nullptr && same->at("gpu").at("frames") > 0;
            text += " " + (timed ? milliseconds(same->at("gpu").at("p50_ms")) : "–") + " |";
        }
        text += "\n";
    }
    return text + whole + "\n" + ratio + "\n";
}

/// A row for each frame of the benchmark; for each size its time and its ratio.
std::string frames_table(const Report& report) {
    std::vector<std::string> columns;
    for (const TimedSize& size : report.sizes) {
        columns.push_back(size_name(size) + ", ms");
        columns.emplace_back("ratio");
    }
    columns.emplace_back("to");
    const bool software = report.sizes.front().frames.at("software");
    std::string text = fmt::format("\n## Frames of a disc\nLeast time of {}, sky included.\n\n",
                                   software ? "all the processor's threads" : "the GPU");
    text += table_head("frame", columns);
    for (const json& frame : report.sizes.front().frames.at("frames")) {
        text += "| " + frame.at("name").get<std::string>() + " |";
        for (const TimedSize& size : report.sizes) {
            const json* same = find(size.frames.at("frames"), frame.at("name"));
            if (same == nullptr) {
                text += " – | – |";
                continue;
            }
            text +=
                fmt::format(" {} | {:.2f} |", milliseconds(same->at("work_ms")), same->at("work_ratio").get<double>());
        }
        text += " " + frame.at("baseline").get<std::string>() + " |\n";
    }
    return text;
}

}  // namespace

bool all_passed(const Report& report) {
    return std::all_of(report.tests.begin(), report.tests.end(),
                       [](const TestResults& results) { return results.failed.empty() && !results.ended_early; });
}

std::string to_markdown(const Report& report) {
    return machine(report) + tests(report) + passes(report) + frames_table(report);
}

}  // namespace rowland::gpu_report
