// The demo without a window, as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/core/file.h"
#include "tests/demo/demo_run.h"
#include "tests/support/files.h"

namespace rowland {
namespace {

using nlohmann::json;

using test::render;
using test::result;
using test::run_demo;

/// Fraction of the pixels that differ by more than rounding and the noise of filtering.
double fraction_that_differs(const image::Image& a, const image::Image& b) {
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        const glm::vec3 difference = glm::abs(a.texels[i] - b.texels[i]);
        differing += std::max({difference.r, difference.g, difference.b}) > 0.01F ? 1U : 0U;
    }
    return static_cast<double>(differing) / static_cast<double>(a.texels.size());
}

float brightest_of(const image::Image& picture) {
    float brightest = 0.0F;
    for (const glm::vec3& texel : picture.texels) brightest = std::max({brightest, texel.r, texel.g, texel.b});
    return brightest;
}

std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

void expect_to_show(const std::filesystem::path& file, const image::Image& empty) {
    SCOPED_TRACE(file.string());
    const image::Image picture = render(file.stem().string(), "--scene '" + file.string() + "'");
    ASSERT_EQ(picture.texels.size(), empty.texels.size());
    const float brightest = brightest_of(picture);
    for (const glm::vec3& texel : picture.texels) {
        ASSERT_TRUE(std::isfinite(texel.r) && std::isfinite(texel.g) && std::isfinite(texel.b));
        ASSERT_GE(std::min({texel.r, texel.g, texel.b}), -0.05F);  // wide colours lie a little outside the space
    }
    // The object fills a cube of 12 cm in a picture 24 cm wide; the flattest file is one thin triangle.
    EXPECT_GT(fraction_that_differs(picture, empty), 0.005);
    EXPECT_LE(brightest, 1.5F * brightest_of(empty));  // the lamps' reflection in the metal sphere
}

TEST(Demo, EveryValidGltfFileIsSeen) {
    ROWLAND_TEST_DATA(valid, "gltf/valid");
    ROWLAND_TEST_DATA(draco, "gltf/draco");
    write_file_atomic(result("empty.gltf"), R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}]})");
    const image::Image empty = render("empty", "--scene " + result("empty.gltf").string());
    for (const std::filesystem::path& folder : {valid, draco})
        for (const std::filesystem::path& file : gltf_files(folder)) expect_to_show(file, empty);
}

TEST(Demo, AMalformedSceneIsRefusedWithNothingWritten) {
    ROWLAND_TEST_DATA(malformed, "gltf/malformed/assimp_IndexOutOfRange/IndexOutOfRange.gltf");
    const std::filesystem::path capture = result("malformed.png");
    std::filesystem::remove(capture);
    const int status = run_demo("--scene '" + malformed.string() + "' --capture " + capture.string());
    EXPECT_EQ(status, 2);
    EXPECT_FALSE(std::filesystem::exists(capture));
}

TEST(Demo, TheLampLightsAndShades) {
    const image::Image without = render("without_lamp", "--disc");
    const image::Image with = render("with_lamp", "--disc --sun");
    std::size_t lit = 0;
    std::size_t as_before = 0;
    // The lower part of the picture is the ground: most of it in the light, some of it in the objects' shadows.
    for (std::size_t i = without.texels.size() * 2 / 3; i < without.texels.size(); ++i) {
        const float gain = with.texels[i].g - without.texels[i].g;
        lit += gain > 0.02F ? 1U : 0U;
        as_before += std::abs(gain) < 1e-3F ? 1U : 0U;
    }
    const double count = static_cast<double>(without.texels.size()) / 3.0;
    EXPECT_GT(static_cast<double>(lit) / count, 0.5);
    EXPECT_GT(static_cast<double>(as_before) / count, 0.02);
}

TEST(Demo, ARecordedSettingIsAsGoodAsAnOption) {
    const auto picture = [](const std::string& name, const std::string& setting, const std::string& options) {
        const std::filesystem::path folder = test::result(name);
        write_file_atomic(folder / "play.jsonl",
                          "{\"rowland_play\":1,\"steps_per_second\":120,\"scene\":\"disc\",\"window\":[64,36]}\n" +
                              setting + "{\"step\":8,\"end\":true}\n");
        EXPECT_EQ(run_demo("--disc --width 64 --height 36 --output-folder " + folder.string() + " --play " +
                           (folder / "play.jsonl").string() + " " + options),
                  0);
        return read_file(folder / "play.png", 1 << 20);
    };
    const std::string darker = "{\"step\":4,\"set\":\"exposure\",\"to\":-3}\n";
    const auto set = picture("set", darker, "");
    EXPECT_EQ(set, picture("option", "", "--exposure -3"));
    EXPECT_NE(set, picture("neither", "", ""));
}

TEST(Demo, TheBenchmarkNamesThePassesThatRunAndOrdersItsPercentiles) {
    const std::filesystem::path path = result("benchmark.json");
    ASSERT_EQ(run_demo("--disc --width 160 --height 90 --frames 12 --bloom 0.1 --benchmark " + path.string()), 0);
    const json report = json::parse(read_text_file(path, 1 << 20));
    EXPECT_EQ(report.at("width"), 160);
    EXPECT_FALSE(report.at("device").get<std::string>().empty());
    const json& frame = report.at("frame");
    EXPECT_EQ(frame.at("frames"), 12);
    EXPECT_GT(frame.at("minimum_ms"), 0.0);
    EXPECT_GT(report.at("times_plain"), 0.2);  // a ratio of two frames' times, on a busy machine
    const std::vector<std::string> order = {"minimum_ms", "p50_ms", "p90_ms", "p95_ms", "p99_ms", "maximum_ms"};
    for (std::size_t i = 1; i < order.size(); ++i) EXPECT_LE(frame.at(order[i - 1]), frame.at(order[i]));
    std::vector<std::string> names;
    for (const json& pass : report.at("passes")) {
        names.push_back(pass.at("name"));
        EXPECT_EQ(pass.at("cpu").at("frames"), 12) << pass;
        EXPECT_GT(pass.at("gpu").at("frames"), 0) << pass;
    }
    EXPECT_THAT(names, testing::IsSupersetOf({"opaque", "sky", "bloom", "display"}));
    EXPECT_THAT(names, testing::Not(testing::Contains("shadow"))) << "no lamp";
    EXPECT_EQ(report.at("drawn").get<int>() + report.at("culled").get<int>(), 4);
    EXPECT_EQ(report.at("baked"), 0);
}

}  // namespace
}  // namespace rowland
