#include "tests/gpu_report/test_results.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>

namespace rowland::gpu_report {

namespace {

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

std::string worst_of(const nlohmann::json& failures) {
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
        worst = value + ", allowed " + limit;
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
        results.failed.push_back({suite + "." + test.at("name").get<std::string>(), worst_of(test.at("failures"))});
    } else if (test.at("result") == "SKIPPED") {
        ++results.skipped;
    } else if (test.at("result") == "COMPLETED") {
        ++results.passed;
        add_difference(test, results);
    }
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

}  // namespace rowland::gpu_report
