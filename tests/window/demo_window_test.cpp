// The demo in a real window, used by real keys and drags under Xvfb. Each test compares two screenshots; the same steps
// without the input under test must leave them equal.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/core/file.h"
#include "engine/image/byte_image.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"
#include "tests/window/needs_xvfb.h"

namespace rowland {
namespace {

/// Of display values, 0 to 255.
int largest_difference(std::span<const std::byte> a, std::span<const std::byte> b) {
    const image::ByteImage first = image::decode_byte_image(a, "a");
    const image::ByteImage second = image::decode_byte_image(b, "b");
    EXPECT_EQ(first.rgba.size(), second.rgba.size());
    int largest = 0;
    for (std::size_t i = 0; i < std::min(first.rgba.size(), second.rgba.size()); ++i)
        largest = std::max(largest, std::abs(int{first.rgba[i]} - int{second.rgba[i]}));
    return largest;
}

class DemoWindow : public ::testing::Test {
 protected:
    /// Starts the demo, stops the disc's turning, plays the actions and ends it.
    void play(const std::vector<std::string>& actions, const std::string& arguments = {}) {
        std::string command = std::string("DROP_FILES=" ROWLAND_DROP_FILES " bash ") + ROWLAND_DRIVE + " " +
                              folder_.path().string() + " key:space";
        for (const std::string& action : actions) command += " '" + action + "'";
        command += std::string(" -- ") + ROWLAND_DEMO + " --width 320 --height 180 --disc --shader-folder " +
                   folder_.path().string() + " " + arguments;
        EXPECT_EQ(std::system(command.c_str()), 0) << command;
    }
    std::vector<std::byte> screenshot(int number) const {
        return read_file(folder_.path() / ("shot_" + std::to_string(number) + ".png"), 1 << 24);
    }
    std::filesystem::path shader(const std::string& name) const {
        return folder_.path() / "engine/render/shaders" / name;
    }

    test::TemporaryFolder folder_;
};

TEST_F(DemoWindow, WithoutInputThePausedPictureStays) {
    ROWLAND_NEEDS_XVFB();
    play({"shot", "shot"});
    EXPECT_TRUE(screenshot(1) == screenshot(2));
}

TEST_F(DemoWindow, ADragTurnsTheCamera) {
    ROWLAND_NEEDS_XVFB();
    play({"shot", "drag:60,20", "shot"});
    EXPECT_TRUE(screenshot(1) != screenshot(2));
}

TEST_F(DemoWindow, KeysSwitchViewProbeExposureAndEffects) {
    ROWLAND_NEEDS_XVFB();
    play({"shot", "key:v", "shot", "key:p", "shot", "key:equal", "shot", "key:1", "shot", "key:2", "shot"});
    for (int number = 1; number < 6; ++number) EXPECT_TRUE(screenshot(number) != screenshot(number + 1)) << number;
}

TEST_F(DemoWindow, ABrokenShaderKeepsTheOldOneAndAMendedOneIsTaken) {
    ROWLAND_NEEDS_XVFB();
    const std::string head = "#version 450 core\nin vec3 direction;\nlayout(location = 0) out vec4 radiance;\n";
    write_file_atomic(folder_.path() / "broken", head + "void main() { radiance = nonsense; }\n");
    write_file_atomic(folder_.path() / "mended", head + "void main() { radiance = vec4(1.0, 0.0, 0.0, 1.0); }\n");
    std::filesystem::create_directories(shader("x").parent_path());
    const std::string sky = shader("sky.frag.glsl").string();
    play({"shot", "run:cp " + (folder_.path() / "broken").string() + " " + sky, "key:F5", "shot",
          "run:cp " + (folder_.path() / "mended").string() + " " + sky, "key:F5", "shot"});
    // F5 makes light and tables anew, too, whose last digits may round another way.
    EXPECT_LE(largest_difference(screenshot(1), screenshot(2)), 1);
    EXPECT_GT(largest_difference(screenshot(2), screenshot(3)), 100);
}

/// A small material file; a first one is there before the demo starts.
std::string material(const char* pitch_nm) {
    return std::string(R"({"grating": {"pitch_nm": )") + pitch_nm +
           R"(, "profile": {"type": "slit", "width_nm": 400}},
               "quality": {"representation": "spikes", "bands": 4, "spikes": 4, "view_resolution": 16}})";
}

TEST_F(DemoWindow, ASavedMaterialShowsByItselfAndABrokenOneKeepsTheOld) {
    ROWLAND_NEEDS_XVFB();
    const std::string path = (folder_.path() / "material.json").string();
    write_file_atomic(path, material("1600"));
    write_file_atomic(path + ".broken", material("-5"));
    write_file_atomic(path + ".other", material("700"));
    play({"shot", "run:cp " + path + ".broken " + path, "wait:1", "shot", "run:cp " + path + ".other " + path,
          "other:10"},
         "--material " + path);
    EXPECT_TRUE(screenshot(1) == screenshot(2));
    EXPECT_TRUE(screenshot(2) != screenshot(3));
}

TEST_F(DemoWindow, AChangedSourceIsCookedAgainAndShown) {
    ROWLAND_NEEDS_XVFB();
    const std::filesystem::path demo(ROWLAND_DEMO);
    const std::filesystem::path cooked = folder_.path() / "cooked";
    const std::filesystem::path source = folder_.path() / "content/meshes/sphere.json";
    std::filesystem::copy(demo.parent_path().parent_path() / "cooked", cooked);
    write_file_atomic(source, R"({"mesh": {"type": "sphere", "radius": 1, "rings": 32, "segments": 64}})");
    write_file_atomic(source.string() + ".other",
                      R"({"mesh": {"type": "sphere", "radius": 1, "rings": 2, "segments": 3}})");
    play({"shot", "wait:1", "run:cp " + source.string() + ".other " + source.string(), "other:10"},
         "--cooked-folder " + cooked.string() + " --content-folder " + (folder_.path() / "content").string());
    EXPECT_TRUE(screenshot(1) != screenshot(2));
}

TEST_F(DemoWindow, AChangedShaderIsTakenWithoutAKey) {
    ROWLAND_NEEDS_XVFB();
    std::filesystem::create_directories(shader("x").parent_path());
    write_file_atomic(folder_.path() / "red",
                      "#version 450 core\nin vec3 direction;\nlayout(location = 0) out vec4 radiance;\n"
                      "void main() { radiance = vec4(1.0, 0.0, 0.0, 1.0); }\n");
    play({"shot", "run:cp " + (folder_.path() / "red").string() + " " + shader("sky.frag.glsl").string(), "other:10"});
    EXPECT_TRUE(screenshot(1) != screenshot(2));
}

TEST_F(DemoWindow, ADroppedProbeLightsTheSceneAndAnythingElseLeavesIt) {
    ROWLAND_NEEDS_XVFB();
    ROWLAND_TEST_DATA(probe, "probes/venice_sunset_256.hdr");
    const std::string letter = (folder_.path() / "letter.txt").string();
    write_file_atomic(letter, "Dear Henry,\n");
    play({"shot", "drop:" + letter, "log:20,letter.txt", "shot", "drop:" + probe.string(), "other:60"});
    EXPECT_TRUE(screenshot(1) == screenshot(2));
    EXPECT_TRUE(screenshot(2) != screenshot(3));
}

TEST_F(DemoWindow, F9WritesTheScenesOwnLight) {
    ROWLAND_NEEDS_XVFB();
    play({"key:F9", "wait:1"});
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "screenshot_0001.exr"));
}

TEST_F(DemoWindow, LLightsTheLamp) {
    ROWLAND_NEEDS_XVFB();
    play({"shot", "key:l", "shot", "key:l", "shot"});
    EXPECT_TRUE(screenshot(1) != screenshot(2));
    EXPECT_TRUE(screenshot(1) == screenshot(3));
}

}  // namespace
}  // namespace rowland
