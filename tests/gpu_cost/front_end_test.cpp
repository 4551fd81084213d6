// Every program of the benchmark's frames, with each feature that a surface may add, through the strict reference front
// end.

#include <algorithm>
#include <set>
#include <sstream>

#include "engine/core/file.h"
#include "engine/render/surface_programs.h"
#include "tests/gpu_cost/captured_frames.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

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

    /// Expects no message on any program of a folder. Equal programs are compiled once.
    static void check(const std::filesystem::path& folder) {
        std::set<std::string> texts;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            const std::string name = entry.path().stem();
            if (entry.path().extension() == ".comp") {
                EXPECT_EQ(messages_of({name + ".comp"}, folder), "") << name;
            }
            if (entry.path().extension() != ".vert") continue;
            const auto text = [&](const char* stage) { return read_text_file(folder / (name + stage), 1 << 24); };
            if (texts.insert(text(".vert") + text(".frag")).second) {
                EXPECT_EQ(messages_of({"-l", name + ".vert", name + ".frag"}, folder), "") << name;
            }
        }
        EXPECT_GT(texts.size(), 5U);
    }

    /// Writes a frame's program with `features` added into a folder.
    static void write_with(SurfaceFeatures features, const CapturedFrame& frame, const std::filesystem::path& folder,
                           const std::string& name) {
        write_file_atomic(folder / (name + ".vert"), with_features(frame.text.vertex, features));
        write_file_atomic(folder / (name + ".frag"), with_features(frame.text.fragment, features));
    }
};

/// All programs as they are and with all features but lights, with which a material defines more than they; that of a
/// planar map with each feature by itself.
TEST_F(FrontEnd, HasNothingToSayOfAnyProgramNorOfItsFeatures) {
    const test::TemporaryFolder captured;
    capture_programs(captured.path(), {});
    check(captured.path());
    const std::vector<CapturedFrame> frames = read_frames(captured.path());
    constexpr SurfaceFeatures second_uv = feature::kNormalMap << feature::kSecondUvShift;
    const test::TemporaryFolder with_features;
    for (const CapturedFrame& frame : frames) {
        std::string name = frame.name;
        std::ranges::replace(name, '/', '-');
        if (frame.name != "unlit")  // reads nothing of the features
            write_with(~(feature::kUnlit | feature::kLights | second_uv), frame, with_features.path(), name);
        if (frame.name != "planar") continue;
        for (unsigned bit = 0; bit < 26; ++bit)
            write_with(1U << bit, frame, with_features.path(), "planar with feature " + std::to_string(bit));
    }
    check(with_features.path());
}

TEST_F(FrontEnd, AnUndeclaredNameIsSaid) {
    const test::TemporaryFolder folder;
    write_file_atomic(folder.path() / "a.frag", "#version 450 core\nvoid main() { missing(); }\n");
    EXPECT_NE(messages_of({"a.frag"}, folder.path()), "");
}

}  // namespace
}  // namespace rowland::gpu_cost
