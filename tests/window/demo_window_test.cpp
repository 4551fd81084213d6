// The demo in a real window, used by real keys and drags under Xvfb. Each test compares screenshots; without the input
// under test they are equal.

#include <algorithm>
#include <cstdlib>

#include "engine/core/file.h"
#include "tests/support/folder_test.h"
#include "tests/window/demo_user.h"

namespace rowland {
namespace {

using test::DemoUser;
using test::same;
using test::operator""s;

/// Of display values, 0 to 255.
int largest_difference(const image::ByteImage& a, const image::ByteImage& b) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    int largest = 0;
    for (std::size_t i = 0; i < std::min(a.rgba.size(), b.rgba.size()); ++i)
        largest = std::max(largest, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
    return largest;
}

class DemoWindow : public test::FolderTest {
 protected:
    void SetUp() override { ROWLAND_NEEDS_VIRTUAL_DISPLAY(); }

    /// Arguments for the disc in a small window, with shaders of the test's own.
    test::Command arguments(const test::Command& more = {}) const {
        test::Command result = {"--width", "320", "--height", "180", "--disc", "--shader-folder", folder_.path()};
        result.insert(result.end(), more.begin(), more.end());
        return result;
    }
    /// The file that replaces the sky's fragment shader.
    std::filesystem::path sky_shader() const {
        std::filesystem::path file = path("engine/render/shaders/sky.frag.glsl");
        std::filesystem::create_directories(file.parent_path());
        return file;
    }
};

/// A sky shader whose main() does this.
std::string sky_that(const std::string& does) {
    return "#version 450 core\nin vec3 direction;\nlayout(location = 0) out vec4 radiance;\nvoid main() { " + does +
           " }\n";
}

TEST_F(DemoWindow, KeysDragsAndDropsChangeThePausedPictureWhichElseStays) {
    ROWLAND_TEST_DATA(probe, "probes/venice_sunset_256.hdr");
    write_file_atomic(path("letter.txt"), std::string_view("A letter.\n"));
    DemoUser user(folder_.path(), arguments());
    user.key("F9");
    EXPECT_TRUE(test::wait_until([&] { return std::filesystem::exists(path("screenshot_0000.exr")); }, 60s))
        << "the scene's own light";
    user.key("space");
    image::ByteImage before = user.shot();
    const auto changed = [&] {
        const image::ByteImage last = std::exchange(before, user.shot());
        return !same(last, before);
    };
    EXPECT_FALSE(changed());
    user.drop(path("letter.txt"));
    user.wait_for_message("letter.txt", 60s);
    EXPECT_FALSE(changed()) << "a letter is no probe";
    const image::ByteImage without_lamp = before;
    user.key("l");
    EXPECT_TRUE(changed()) << "the lamp";
    user.key("l");
    EXPECT_TRUE(changed());
    EXPECT_TRUE(same(before, without_lamp));

    write_file_atomic(sky_shader(), sky_that("radiance = nonsense;"));
    user.key("F5");
    const image::ByteImage broken = user.shot();
    write_file_atomic(sky_shader(), sky_that("radiance = vec4(1.0, 0.0, 0.0, 1.0);"));
    user.key("F5");
    // F5 rebuilds light and tables as well, whose last digits may round another way.
    EXPECT_LE(largest_difference(before, broken), 1) << "a broken shader keeps the old one";
    EXPECT_GT(largest_difference(broken, before = user.shot()), 100) << "a mended one is taken";

    for (const char* key : {"v", "p", "equal", "1", "2"}) {
        user.key(key);
        EXPECT_TRUE(changed()) << key;
    }
    user.drag({100, 160}, {60, 10});  // below the messages, on the ground
    EXPECT_TRUE(changed()) << "a drag turns the camera";
    user.drop(probe);
    EXPECT_FALSE(same(before, user.shot_unlike(before, 60s))) << "a probe lights the scene";
}

/// A small material file.
std::string material(const char* pitch_nm) {
    return std::string(R"({"grating": {"pitch_nm": )") + pitch_nm +
           R"(, "profile": {"type": "slit", "width_nm": 400}},
               "quality": {"representation": "spikes", "bands": 4, "spikes": 4, "view_resolution": 16}})";
}

/// Files that the demo watches: a saved one shows without a key, a broken one keeps the old.
TEST_F(DemoWindow, SavedMaterialsSourcesAndShadersShowByThemselves) {
    const std::filesystem::path source = path("content/meshes/sphere.json");
    std::filesystem::copy(std::filesystem::path(ROWLAND_DEMO).parent_path().parent_path() / "cooked", path("cooked"));
    write_file_atomic(source, R"({"mesh": {"type": "sphere", "radius": 1, "rings": 32, "segments": 64}})");
    write_file_atomic(path("material.json"), material("1600"));
    const std::filesystem::path shader = sky_shader();
    DemoUser user(folder_.path(), arguments({"--material", path("material.json"), "--cooked-folder", path("cooked"),
                                             "--content-folder", path("content")}));
    user.key("space");
    image::ByteImage before = user.shot();
    write_file_atomic(path("material.json"), material("-5"));
    user.wait_for_message("pitch_nm", 60s);
    EXPECT_TRUE(same(before, user.shot()));
    const auto shows = [&](const std::filesystem::path& file, const std::string& text) {
        write_file_atomic(file, text);
        const image::ByteImage last = std::exchange(before, user.shot_unlike(before, 60s));
        return !same(last, before);
    };
    EXPECT_TRUE(shows(path("material.json"), material("700")));
    before = user.settled_shot(60s);
    EXPECT_TRUE(shows(source, R"({"mesh": {"type": "sphere", "radius": 1, "rings": 2, "segments": 3}})"));
    before = user.settled_shot(60s);
    EXPECT_TRUE(shows(shader, sky_that("radiance = vec4(1.0, 0.0, 0.0, 1.0);")));
}

}  // namespace
}  // namespace rowland
