// Every program of the benchmark's frames, with each feature that a surface may add, through the strict reference front
// end.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "engine/core/file.h"
#include "engine/render/surface_features.h"
#include "tests/gpu_cost/captured_frames.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace rowland::gpu_cost {
namespace {

using render::SurfaceFeatures;
namespace feature = render::feature;

/// What glslangValidator says of files besides their names; nullopt where it is missing.
std::optional<std::string> messages_of(test::Command arguments, const std::filesystem::path& folder) {
    arguments.insert(arguments.begin(), {"/usr/bin/env", "glslangValidator"});
    const test::Ended ended = test::run(arguments, {.folder = folder, .limit = std::chrono::minutes(10)});
    if (ended.code == 127) return std::nullopt;
    std::string messages = ended.err;
    std::istringstream lines(ended.out);
    for (std::string line; std::getline(lines, line);)
        if (!line.empty() && !std::filesystem::exists(folder / line)) messages += line + "\n";
    if (ended.code != 0 && messages.empty()) messages = "ends with code " + std::to_string(ended.code);
    return messages;
}

/// A stage's text with the defines that it lacks.
std::string with_features(const std::string& text, SurfaceFeatures features) {
    const std::size_t first_line = text.find('\n') + 1;  // #version
    std::string defines;
    for (const gpu::Define& define : render::defines_of(features))
        if (text.find("#define " + define.first + " ") == std::string::npos)
            defines += "#define " + define.first + " " + define.second + "\n";
    return text.substr(0, first_line) + defines + text.substr(first_line);
}

class FrontEnd : public testing::Test {
 protected:
    void SetUp() override {
        if (!messages_of({"--version"}, ".")) GTEST_SKIP() << "needs glslangValidator (Debian: glslang-tools)";
    }

    /// Expects no message on any stage alone, or on two linked.
    static void check(const std::filesystem::path& folder) {
        test::Command stages;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (entry.path().extension() != ".json") stages.push_back(entry.path().filename());
        EXPECT_GT(stages.size(), 10U);
        EXPECT_EQ(messages_of(stages, folder), "");
        for (const std::string& stage : stages) {
            if (!stage.ends_with(".vert")) continue;
            const std::string name = stage.substr(0, stage.size() - 5);
            EXPECT_EQ(messages_of({"-l", stage, name + ".frag"}, folder), "") << name;
        }
    }

    /// Expects no message on the frames' programs with `features` added.
    static void check_with(SurfaceFeatures features, const std::vector<CapturedFrame>& frames) {
        const test::TemporaryFolder folder;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            if (frames[i].name == "unlit") continue;  // reads nothing of the features
            const std::string name = std::to_string(i);
            write_file_atomic(folder.path() / (name + ".vert"), with_features(frames[i].text.vertex, features));
            write_file_atomic(folder.path() / (name + ".frag"), with_features(frames[i].text.fragment, features));
        }
        check(folder.path());
    }

    const test::TemporaryFolder captured_;
};

TEST_F(FrontEnd, HasNothingToSayOfAnyProgram) {
    capture_programs(captured_.path(), {});
    check(captured_.path());
}

TEST_F(FrontEnd, HasNothingToSayOfAFeatureInTheProgramsOfPlanes) {
    capture_programs(captured_.path(), {"planar*"});
    const std::vector<CapturedFrame> frames = read_frames(captured_.path());
    for (unsigned bit = 0; bit < 26; ++bit) {
        SCOPED_TRACE("feature " + std::to_string(bit));
        const SurfaceFeatures one = 1U << bit;
        if (!render::defines_of(one).empty()) check_with(one, frames);
    }
}

// Lights are left out: with them a material defines more than they.
TEST_F(FrontEnd, HasNothingToSayOfAllFeaturesTogether) {
    capture_programs(captured_.path(), {});
    constexpr SurfaceFeatures second_uv = feature::kNormalMap << feature::kSecondUvShift;
    check_with(~(feature::kUnlit | feature::kLights | second_uv), read_frames(captured_.path()));
}

TEST_F(FrontEnd, AnUndeclaredNameIsSaid) {
    const test::TemporaryFolder folder;
    write_file_atomic(folder.path() / "a.frag", "#version 450 core\nvoid main() { missing(); }\n");
    EXPECT_NE(messages_of({"a.frag"}, folder.path()), "");
}

}  // namespace
}  // namespace rowland::gpu_cost
