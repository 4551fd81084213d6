#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace rowland::gpu_report {

/// A test that failed, with the worst of what it compared: "0.0043, allowed 0.002", or what else it said.
struct FailedTest {
    std::string name;
    std::string worst;
};

/// The results of a program of tests.
struct TestResults {
    std::string program;
    int passed = 0;
    int skipped = 0;
    std::vector<FailedTest> failed;
    /// Largest difference between a picture and the CPU's, over its brightest component, of the tests that passed.
    std::optional<double> largest_difference;
    bool ended_early = false;  ///< it wrote no results
};

/// From GoogleTest's JSON output; nullopt: there is none.
TestResults results_of(const std::string& program, const std::optional<std::string>& json);

/// What was drawn at one size.
struct TimedSize {
    nlohmann::json frames;  ///< rowland-benchmark's results
    nlohmann::json flight;  ///< rowland-demo's times of a flight through the cabinet
};

struct Report {
    std::string revision;  ///< of the sources
    std::vector<TestResults> tests;
    std::vector<TimedSize> sizes;
};

bool all_passed(const Report& report);

/// As Markdown: the GPU and its driver, the tests, times per pass and times of the benchmark's frames.
std::string to_markdown(const Report& report);

}  // namespace rowland::gpu_report
