#include "tests/gpu_cost/cost_table.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/support/expect.h"

namespace rowland::gpu_cost {
namespace {

FrameCost frame(const std::string& name, double fragment, double vertex) {
    return {name, {{.inverse_throughput = fragment}, 0.0}, {{.inverse_throughput = vertex}, 0.0}};
}

std::vector<GenerationCost> costs_of(double arc, const std::string& driver = "Mesa 1") {
    GenerationCost cost{"RDNA2", "a GPU", driver, {frame("plain", 400.0, 100.0), frame("arc", arc, 200.0)}};
    divide_by_plain(cost);
    return {cost};
}

std::vector<std::string> grown(double before, double after) {
    return compare_with(to_json(costs_of(before)), "held.json", costs_of(after)).grown;
}

TEST(CostTable, RatiosAreToThePlainFrameStageByStage) {
    const GenerationCost cost = costs_of(600.0).front();
    EXPECT_EQ(cost.frames[0].fragment.times_plain, 1.0);
    EXPECT_EQ(cost.frames[1].fragment.times_plain, 1.5);
    EXPECT_EQ(cost.frames[1].vertex.times_plain, 2.0);
    EXPECT_THAT(to_text(cost), testing::HasSubstr("arc        1.50     600"));
}

TEST(CostTable, ARatioMayGrowByFivePercent) {
    EXPECT_THAT(grown(600.0, 500.0), testing::IsEmpty());
    EXPECT_THAT(grown(600.0, 628.0), testing::IsEmpty());
    EXPECT_THAT(grown(600.0, 632.0), testing::ElementsAre("RDNA2, arc, fragment stage: 1.580 × plain, was 1.500"));
}

TEST(CostTable, AFrameThatIsNoLongerMeasuredIsReported) {
    std::vector<GenerationCost> costs = costs_of(600.0);
    costs.front().frames.pop_back();
    EXPECT_THAT(compare_with(to_json(costs_of(600.0)), "held.json", costs).grown,
                testing::ElementsAre("RDNA2, arc: not measured"));
}

TEST(CostTable, RatiosOfAnotherCompilerAreNotCompared) {
    const Comparison comparison = compare_with(to_json(costs_of(600.0)), "held.json", costs_of(900.0, "Mesa 2"));
    EXPECT_FALSE(comparison.same_driver);
    EXPECT_THAT(comparison.grown, testing::IsEmpty());
}

TEST(CostTable, AnotherFileIsRefusedByName) {
    for (const char* text : {"", "[{}]", "{\"frames\": 3}", "[{\"name\": \"RDNA2\", \"driver\": \"Mesa 1\"}]"})
        EXPECT_THAT(test::message_of([&] { compare_with(text, "held.json", costs_of(600.0)); }),
                    testing::StartsWith("held.json: "))
            << text;
}

}  // namespace
}  // namespace rowland::gpu_cost
