// The program, where AMD's compiler is installed.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland::gpu_cost {
namespace {

using nlohmann::json;

class GpuCost : public testing::Test {
 protected:
    void SetUp() override {
        if (!std::filesystem::exists(kProgram))
            GTEST_SKIP() << "needs Vulkan's headers when the build is configured (Debian: libvulkan-dev)";
        const test::Ended ended = run({"--only", "unlit"});
        if (ended.code == 1 && ended.err.find("install it") != std::string::npos) GTEST_SKIP() << ended.err;
        ASSERT_EQ(ended.code, 0) << ended.err;
    }

    static test::Ended run(test::Command arguments, test::Surroundings surroundings = {}) {
        arguments.insert(arguments.begin(), kProgram);
        surroundings.limit = std::chrono::minutes(20);
        surroundings.environment["ASAN_OPTIONS"] = "detect_leaks=0";  // RADV's null device leaks 128 bytes
        return test::run(arguments, surroundings);
    }
    static json frames_of(const std::string& only) {
        const test::TemporaryFolder folder;
        const std::filesystem::path path = folder.path() / "cost.json";
        const test::Ended ended = run({"--only", only, "--json", path.string()});
        EXPECT_EQ(ended.code, 0) << ended.err;
        return json::parse(read_text_file(path, 1 << 24)).at(0).at("frames");
    }

    static constexpr const char* kProgram = ROWLAND_GPU_COST;
};

TEST_F(GpuCost, RatiosHaveNotGrown) {
    const test::Ended ended = run({"--check", ROWLAND_HELD_COSTS});
    if (ended.out.find("not compared") != std::string::npos)
        GTEST_SKIP() << "the held ratios are by another version of Mesa";
    EXPECT_EQ(ended.code, 0) << ended.out.substr(std::min(ended.out.find("grown:"), ended.out.size())) << ended.err;
}

TEST_F(GpuCost, EachLightCostsWhatTheOneBeforeItDid) {
    const json frames = frames_of("plain/lights:*");
    const auto cycles = [&](const char* name) {
        return frames.at(name).at("fragment").at("inverse_throughput").get<double>();
    };
    const double one = (cycles("plain/lights:16") - cycles("plain/lights:4")) / 12.0;
    EXPECT_GT(one, 10.0);
    EXPECT_NEAR((cycles("plain/lights:64") - cycles("plain/lights:16")) / 48.0, one, 0.01 * one);
}

TEST_F(GpuCost, AnEffectCostsItsPassesAndMoreAtTheSurface) {
    const json frames = frames_of("plain/ambient-occlusion");
    EXPECT_GT(frames.at("plain/ambient-occlusion").at("fragment").at("times_plain"), 1.0);
    for (const char* pass : {"/pass:1", "/pass:2"})
        EXPECT_GE(frames.at(std::string("plain/ambient-occlusion") + pass).at("fragment").at("fetches"), 8) << pass;
    EXPECT_EQ(frames.size(), 4U);  // and "plain"
}

TEST_F(GpuCost, AMissingFrontEndIsNamedWithItsPackage) {
    const test::Ended ended = run({"--only", "unlit"}, {.environment = {{"PATH", "/nowhere"}}});
    EXPECT_EQ(ended.code, 1);
    EXPECT_THAT(ended.err, testing::HasSubstr("glslang-tools"));
}

TEST_F(GpuCost, AFrameThatDoesNotExistIsRefused) {
    const test::Ended ended = run({"--only", "arcs"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, testing::HasSubstr("--only: arcs"));
}

}  // namespace
}  // namespace rowland::gpu_cost
