#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <glm/mat4x4.hpp>

#include "editor/inspector/pick_point.h"
#include "editor/inspector/preview.h"
#include "engine/core/file.h"
#include "engine/image/byte_image.h"
#include "engine/scene/transform.h"
#include "tests/support/environment.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland::inspector {
namespace {

using testing::HasSubstr;

const std::string kContent = test::source_path("content").string();

class InspectorProgram : public testing::Test {
 protected:
    test::Ended run(const std::string& program, const std::string& arguments) const {
        return test::run(test::command(program, arguments), {.limit = std::chrono::seconds(400)});
    }
    test::Ended inspect(const std::string& arguments) const {
        return run(ROWLAND_INSPECTOR, "--layout " + path("none.json") + " " + arguments);
    }
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

    test::TemporaryFolder folder_;
};

TEST_F(InspectorProgram, HelpShowsAnExampleAndTheKeys) {
    const test::Ended help = inspect("--help");
    EXPECT_EQ(help.code, 0);
    EXPECT_THAT(help.out, testing::AllOf(HasSubstr("example:"), HasSubstr("--capture"), HasSubstr("Ctrl+Z")));
}

TEST_F(InspectorProgram, WhatCannotBeOpenedIsRefusedByName) {
    write_file_atomic(path("corrupt.json"), "{\"grating\": {\"pitch_nm\": 16");
    write_file_atomic(path("huge.json"), std::string(40 << 20, ' '));
    write_file_atomic(path("bad.glb"), "glTF");
    const char* const odd_name = test::has_posix_files() ? "caf\xe9.json" : "caf\xc3\xa9.json";
    write_file_atomic(path(odd_name), "[1]");
    for (const auto& [option, name] : {std::pair("", "corrupt.json"),
                                       {"", "huge.json"},
                                       {"", "bad.glb"},
                                       {"", "missing.json"},
                                       {"", odd_name},
                                       {"--probe", "missing.hdr"}}) {
        const test::Ended refused = inspect(fmt::format("{} '{}' --capture '{}'", option, path(name), path("x.png")));
        EXPECT_EQ(refused.code, 2) << name << ": " << refused.err;
        EXPECT_THAT(refused.err, HasSubstr(name));
        EXPECT_EQ(refused.err.find("error: "), refused.err.rfind("error: ")) << "once";
        EXPECT_FALSE(std::filesystem::exists(path("x.png")));
    }
}

TEST_F(InspectorProgram, BadUsageIsRefused) {
    for (const char* usage : {"--size 12", "--size 100x100", "--size 1280x99999999999", "--size nanx800",
                              "--shape teapot", "--scale 9", "--scale nan", "--scale inf", "--nonsense"}) {
        const test::Ended refused = inspect(usage);
        EXPECT_EQ(refused.code, 2) << usage;
        EXPECT_THAT(refused.err, HasSubstr("--help"));
    }
}

TEST_F(InspectorProgram, OutputsAreCheckedBeforeWork) {
    const std::string material = R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}}})";
    write_file_atomic(path("mine.json"), material);
    for (const std::string& outputs :
         {"--capture '" + path("a.jpg") + "'", std::string("--capture /dev/full"),
          std::string("--capture /proc/nowhere/a.png"), fmt::format("--capture '{0}' --controls '{0}'", path("a.png")),
          fmt::format("--controls '{}'", path("mine.json")), fmt::format("--layout '{}'", path("mine.json"))}) {
        const test::Ended refused = run(ROWLAND_INSPECTOR, fmt::format("'{}' {}", path("mine.json"), outputs));
        EXPECT_EQ(refused.code, 2) << outputs << ": " << refused.err;
        EXPECT_EQ(read_text_file(path("mine.json"), 1 << 10), material);
    }
}

/// Whether the disc covers a pixel and all its neighbours, so that no edge is in it.
bool inside_disc(const scene::Mesh& disc, int column, int row, glm::ivec2 size) {
    // As the demo's stand leans at rest.
    const glm::mat4 placed = scene::Transform{.translation = {0.0F, 0.052F, 0.0F},
                                              .rotation = glm::angleAxis(glm::radians(52.0F), glm::vec3(1, 0, 0))}
                                 .matrix();
    for (const int dx : {-2, 2})
        for (const int dy : {-2, 2}) {
            const glm::dvec2 at(column + dx + 0.5, row + dy + 0.5);
            if (!pick_point(disc, placed, scene::ray_through(opening_camera(), at, size))) return false;
        }
    return true;
}

image::ByteImage read_picture(const std::string& file) {
    return image::decode_byte_image(read_file(file, 1 << 24), file);
}

TEST_F(InspectorProgram, ThePreviewsPixelsAreTheDemos) {
    constexpr glm::ivec2 kSize(320, 320);
    const std::string material = kContent + "/materials/cd.json";
    const std::string probe = path("lamp.json");
    write_file_atomic(probe, R"({"probe": {"type": "studio", "width": 128, "key_lights": 2,
        "ceiling": [1, 1, 1], "wall": [0.6, 0.5, 0.4], "floor": [0.3, 0.3, 0.4], "boxes": [
        {"azimuth_deg": 160, "elevation_deg": 40, "half_size_deg": [20, 12], "radiance": [40, 30, 20]}]}})");
    const test::Ended demo = run(
        ROWLAND_DEMO, fmt::format("--disc --headless --no-ambient-occlusion --no-soft-shadows --no-local-reflections "
                                  "--material '{}' --probe '{}' --width {} --height {} --capture '{}'",
                                  material, probe, kSize.x, kSize.y, path("demo.png")));
    ASSERT_EQ(demo.code, 0) << demo.err;
    const test::Ended preview =
        inspect(fmt::format("'{}' --probe '{}' --shape disc --size {}x{} --preview-only --capture '{}'", material,
                            probe, kSize.x, kSize.y, path("preview.png")));
    ASSERT_EQ(preview.code, 0) << preview.err;

    const image::ByteImage one = read_picture(path("demo.png"));
    const image::ByteImage other = read_picture(path("preview.png"));
    ASSERT_EQ(one.rgba.size(), other.rgba.size());
    const scene::Mesh disc = preview_mesh(PreviewShape::Disc);
    int compared = 0;
    int largest = 0;
    int brightest = 0;
    for (int row = 4; row < kSize.y - 4; row += 3)
        for (int column = 4; column < kSize.x - 4; column += 3) {
            if (!inside_disc(disc, column, row, kSize)) continue;
            ++compared;
            for (int i = 0; i < 3; ++i) {
                const auto at = static_cast<std::size_t>(4 * (row * kSize.x + column) + i);
                largest = std::max(largest, std::abs(int(one.rgba[at]) - int(other.rgba[at])));
                brightest = std::max(brightest, int(one.rgba[at]));
            }
        }
    EXPECT_GT(compared, 300);
    EXPECT_GT(brightest, 150);  // there is something to compare
    EXPECT_LE(largest, 1);      // the demo's disc is the same mesh, quantised
}

}  // namespace
}  // namespace rowland::inspector
