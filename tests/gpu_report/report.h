#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/gpu_report/test_results.h"

namespace rowland::gpu_report {

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
