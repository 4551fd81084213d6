#include "tests/gpu_report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <regex>

namespace rowland::gpu_report {

namespace {

using nlohmann::json;

/// Tests also compare pictures that differ on purpose, by more than any tolerance.
constexpr double kMeantToDiffer = 0.02;

/// What a failure of a comparison says: groups are the value and its limit.
const std::regex& comparison() {
    static const std::regex pattern(
        R"(actual: ([-+.eE\d]+|-?nan|inf) vs ([-+.eE\d]+)|is ([-+.eE\d]+|-?nan|inf), which exceeds ([-+.eE\d]+))");
    return pattern;
}

/// The first line of a failure after its file and line.
std::string first_line(const std::string& failure) {
    const std::size_t start = failure.find('\n');
    if (start == std::string::npos) return failure;
    return failure.substr(start + 1, failure.find('\n', start + 1) - start - 1);
}

std::string worst_comparison(const nlohmann::json& failures) {
    std::string worst;
    double largest = -1.0;
    for (const nlohmann::json& one : failures) {
        const std::string failure = one.at("failure");
        std::smatch found;
        if (!std::regex_search(failure, found, comparison())) {
            if (worst.empty()) worst = first_line(failure);
            continue;
        }
        const std::string value = found[1].matched ? found[1] : found[3];
        const std::string limit = found[2].matched ? found[2] : found[4];
        const double excess = std::abs(std::strtod(value.c_str(), nullptr) / std::strtod(limit.c_str(), nullptr));
        if (excess <= largest) continue;  // NaN is the worst of all
        largest = std::isnan(excess) ? std::numeric_limits<double>::infinity() : excess;
        worst = fmt::format("{}, allowed {}", value, limit);
    }
    return worst;
}

void add_difference(const nlohmann::json& test, TestResults& results) {
    if (!test.contains("largest_difference")) return;
    const double difference = std::stod(test.at("largest_difference").get<std::string>());
    if (difference < kMeantToDiffer)
        results.largest_difference = std::max(results.largest_difference.value_or(0.0), difference);
}

void add(const std::string& suite, const nlohmann::json& test, TestResults& results) {
    if (test.contains("failures")) {
        results.failed.push_back(
            {suite + "." + test.at("name").get<std::string>(), worst_comparison(test.at("failures"))});
    } else if (test.at("result") == "SKIPPED") {
        ++results.skipped;
    } else if (test.at("result") == "COMPLETED") {
        ++results.passed;
        add_difference(test, results);
    }
}

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

TestResults results_of(const std::string& program, const std::optional<std::string>& json) {
    TestResults results;
    results.program = program;
    const auto parsed = nlohmann::json::parse(json.value_or(""), nullptr, false);
    results.ended_early = parsed.is_discarded();
    if (results.ended_early) return results;
    for (const nlohmann::json& suite : parsed.at("testsuites"))
        for (const nlohmann::json& test : suite.at("testsuite")) add(suite.at("name"), test, results);
    return results;
}

bool all_passed(const Report& report) {
    return std::all_of(report.tests.begin(), report.tests.end(),
                       [](const TestResults& results) { return results.failed.empty() && !results.ended_early; });
}

std::string to_markdown(const Report& report) {
    return machine(report) + tests(report) + passes(report) + frames_table(report);
}

}  // namespace rowland::gpu_report
