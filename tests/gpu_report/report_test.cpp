#include "tests/gpu_report/report.h"

#include <gmock/gmock.h>

namespace rowland::gpu_report {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// GoogleTest's JSON of tests, each with what is given beside its name.
std::string output_of(const std::vector<json>& tests) {
    json suite = {{"name", "Arc"}, {"testsuite", json::array()}};
    for (json test : tests) {
        test["name"] = "Test" + std::to_string(suite["testsuite"].size());
        suite["testsuite"].push_back(test);
    }
    return json{{"testsuites", json::array({suite})}}.dump();
}

json failures(const std::vector<std::string>& messages) {
    json list = json::array();
    for (const std::string& message : messages) list.push_back({{"failure", "arc_test.cpp:3\n" + message}});
    return {{"result", "COMPLETED"}, {"failures", list}};
}

std::string worst_of(const std::vector<std::string>& messages) {
    const TestResults results = results_of("test_gpu", output_of({failures(messages)}));
    EXPECT_EQ(results.failed.size(), 1U);
    return results.failed.at(0).worst;
}

TEST(TestResults, AreCountedByOutcome) {
    const TestResults results =
        results_of("test_gpu", output_of({{{"result", "COMPLETED"}, {"largest_difference", "0.0001"}},
                                          {{"result", "COMPLETED"}, {"largest_difference", "0.0004"}},
                                          {{"result", "COMPLETED"}, {"largest_difference", "0.7"}},  // on purpose
                                          {{"result", "SKIPPED"}},
                                          {{"result", "SUPPRESSED"}},
                                          failures({"Expected: (a) < (b), actual: 0.004 vs 0.002\n"})}));
    EXPECT_EQ(results.passed, 3);
    EXPECT_EQ(results.skipped, 1);
    EXPECT_EQ(results.largest_difference, 0.0004);
    ASSERT_EQ(results.failed.size(), 1U);
    EXPECT_EQ(results.failed[0].name, "Arc.Test5");
    EXPECT_FALSE(results.ended_early);
}

TEST(TestResults, NameTheWorstComparison) {
    EXPECT_EQ(worst_of({"Expected: (a) < (b), actual: 0.004 vs 0.002", "Expected: (a) < (b), actual: 0.02 vs 0.002",
                        "Expected: (a) < (b), actual: 0.003 vs 0.002"}),
              "0.02, allowed 0.002");
    EXPECT_EQ(worst_of({"The difference between a and b is 0.5, which exceeds 1e-3, where"}), "0.5, allowed 1e-3");
    EXPECT_EQ(worst_of({"Expected: (a) < (b), actual: 3 vs 2", "Expected: (a) < (b), actual: nan vs 2"}),
              "nan, allowed 2");
    EXPECT_EQ(worst_of({"Value of: shown\n  Actual: false"}), "Value of: shown");
}

TEST(TestResults, OfAProgramThatCrashedAreMissing) {
    EXPECT_TRUE(results_of("test_gpu", std::nullopt).ended_early);
    EXPECT_TRUE(results_of("test_gpu", "{\"testsuites\": [").ended_early);
}

TimedSize size_of(int width, int height, double arc_ms) {
    const json frames = {
        {{"name", "plain"}, {"baseline", "plain"}, {"work_ms", 1.0}, {"work_ratio", 1.0}},
        {{"name", "arc"}, {"baseline", "plain"}, {"work_ms", arc_ms}, {"work_ratio", arc_ms}},
    };
    const json passes = {{{"name", "opaque"}, {"gpu", {{"frames", 9}, {"p50_ms", 0.25 * arc_ms}}}},
                         {{"name", "sky"}, {"gpu", {{"frames", 0}, {"p50_ms", 0.0}}}}};
    return {{{"width", width},
             {"height", height},
             {"processor", "a processor"},
             {"gl_vendor", "a vendor"},
             {"gl_renderer", "a GPU"},
             {"gl_version", "4.6 driver 5"},
             {"software", false},
             {"frames", frames}},
            {{"frame", {{"p50_ms", 3.5}}}, {"times_plain", 1.25}, {"passes", passes}}};
}

TEST(GpuReport, NamesGpuTestsPassesAndRatios) {
    Report report{.revision = "abc", .tests = {}, .sizes = {size_of(1920, 1080, 1.5), size_of(3840, 2160, 6.0)}};
    report.tests.push_back(
        results_of("test_gpu", output_of({{{"result", "COMPLETED"}, {"largest_difference", "1e-4"}}})));
    EXPECT_TRUE(all_passed(report));
    report.tests.push_back(results_of("test_gpu_ui", output_of({failures({"actual: 4 vs 2"})})));
    report.tests.push_back(results_of("test_gpu_post", std::nullopt));
    EXPECT_FALSE(all_passed(report));
    const std::string text = to_markdown(report);
    for (const char* line : {"# Rowland on a GPU\n", "a vendor, OpenGL 4.6 driver 5; a processor; sources abc",
                             "| test_gpu | 1 | 0 | 0 | 1.0e-04 |", "| test_gpu_ui | 0 | 1 | 0 | – |",
                             "test_gpu_post | ended without results", "- failed: `Arc.Test0`: 4, allowed 2",
                             "| pass | 1920×1080 | 3840×2160 |", "| opaque | 0.375 | 1.500 |", "| sky | – | – |",
                             "| arc | 1.500 | 1.50 | 6.000 | 6.00 | plain |"})
        EXPECT_THAT(text, HasSubstr(line));
}

TEST(GpuReport, AProgramThatCrashedIsAFailure) {
    Report report;
    report.tests.push_back(results_of("test_gpu", std::nullopt));
    EXPECT_FALSE(all_passed(report));
}

}  // namespace
}  // namespace rowland::gpu_report
