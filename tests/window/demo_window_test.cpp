// The demo in a real window, used by real keys and drags under Xvfb. Each test compares two screenshots; the same steps
// without the input under test must leave them equal.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"

namespace rowland {
namespace {

bool has_tools() {
    return std::system("command -v xvfb-run xdotool >/dev/null 2>&1") == 0;
}

#define ROWLAND_NEEDS_XVFB()                                                            \
    if (!has_tools()) {                                                                 \
        if (test::data_is_required()) FAIL() << "xvfb-run or xdotool is not installed"; \
        GTEST_SKIP() << "xvfb-run or xdotool is not installed";                         \
    }                                                                                   \
    static_assert(true)

class DemoWindow : public ::testing::Test {
 protected:
    /// Starts the demo, stops the disc's turning, plays the actions and ends it.
    void play(const std::vector<std::string>& actions) {
        std::string command = std::string("bash ") + ROWLAND_DRIVE + " " + folder_.path().string() + " key:space";
        for (const std::string& action : actions) command += " '" + action + "'";
        command +=
            std::string(" -- ") + ROWLAND_DEMO + " --width 320 --height 180 --shader-folder " + folder_.path().string();
        EXPECT_EQ(std::system(command.c_str()), 0) << command;
    }
    std::vector<std::byte> screenshot(int number) const {
        return read_file(folder_.path() / ("screenshot_000" + std::to_string(number) + ".png"), 1 << 24);
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
    EXPECT_TRUE(screenshot(1) == screenshot(2));
    EXPECT_TRUE(screenshot(2) != screenshot(3));
}

}  // namespace
}  // namespace rowland
