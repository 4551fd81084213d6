// Scenes that bring a camera of their own, and the cabinet, which shows every kind of grating.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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

/// A square of 1 m, 2 m before a camera that sees 2 m there; nothing else. The square is unlit and magenta.
json framed_square() {
    return {{"asset", {{"version", "2.0"}}},
            {"extensionsUsed", {"KHR_materials_unlit"}},
            {"scene", 0},
            {"scenes", {{{"nodes", {0, 1}}}}},
            {"nodes", {{{"mesh", 0}, {"translation", {3, 4, 5}}}, {{"camera", 0}, {"translation", {3, 4, 7}}}}},
            {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 2.0 * std::atan(0.5)}, {"znear", 0.1}}}}}},
            {"materials",
             {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0, 0.5, 1}}}},
               {"doubleSided", true},
               {"extensions", {{"KHR_materials_unlit", json::object()}}}}}},
            {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"mode", 5}, {"material", 0}}}}}}},
            {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}}}},
            {"bufferViews", {{{"buffer", 0}, {"byteLength", 48}}}},
            {"buffers",
             {{{"byteLength", 48},
               {"uri",
                "data:application/octet-stream;base64,"
                "AAAAvwAAAL8AAAAAAAAAPwAAAL8AAAAAAAAAvwAAAD8AAAAAAAAAPwAAAD8AAAAA"}}}}};
}

/// The texel so many to the right of the picture's middle and above it.
glm::vec3 from_middle(const image::Image& picture, int right, int up) {
    return picture
        .texels[static_cast<std::size_t>((picture.height / 2 - up) * picture.width + picture.width / 2 + right)];
}

TEST(DemoCabinet, ASceneWithACameraIsShownThroughItAtItsOwnSize) {
    write_file_atomic(test::result("framed_square.gltf"), framed_square().dump());
    const image::Image picture =
        test::render("framed_square", "--scene " + test::result("framed_square.gltf").string());
    // Half the picture's height: 27 of the 108 texels from the middle. Nothing else is magenta.
    const glm::vec3 square = from_middle(picture, 0, 0);
    for (int up = -53; up < 54; ++up)
        for (int right = -95; right < 96; ++right) {
            const int farthest = std::max(std::abs(right), std::abs(up));
            const glm::vec3 texel = from_middle(picture, right, up);
            if (farthest < 26) {
                ASSERT_EQ(texel, square) << right << ", " << up;
            } else if (farthest > 28) {
                ASSERT_NE(texel, square) << right << ", " << up;
            }
        }
}

TEST(DemoCabinet, ASpinningNodeTurnsAboutItsAxis) {
    json file = framed_square();
    file["nodes"][0]["extras"]["spin_axis"] = {0, 0, 1};
    write_file_atomic(test::result("spinning.gltf"), file.dump());
    // In half a second it turns by 10 degrees, its right upper corner from 45 to 55 degrees.
    test::run_demo("--width 192 --height 108 --frames 16 --scene " + test::result("spinning.gltf").string() +
                   " --capture-linear " + test::result("spinning.exr").string());
    const image::Image first = image::load_image(test::result("spinning_0000.exr"));
    const image::Image turned = image::load_image(test::result("spinning_0015.exr"));
    const glm::vec3 square = from_middle(first, 0, 0);
    EXPECT_EQ(from_middle(first, 25, 25), square);
    EXPECT_NE(from_middle(first, 20, 29), square);
    EXPECT_NE(from_middle(turned, 25, 25), square);
    EXPECT_EQ(from_middle(turned, 20, 29), square);
}

/// Part of a picture, in fractions of its width and height from the left and the top.
struct Region {
    const char* name;
    double left, right, top, bottom;
};

// Where the opening view has the gratings.
constexpr std::array<Region, 6> kGratings = {{{"record", 0.05, 0.31, 0.03, 0.45},
                                              {"CD", 0.26, 0.38, 0.46, 0.64},
                                              {"DVD", 0.425, 0.535, 0.40, 0.57},
                                              {"foil card", 0.56, 0.655, 0.62, 0.72},
                                              {"grating rule", 0.29, 0.53, 0.80, 0.84},
                                              {"beetle", 0.70, 0.765, 0.46, 0.55}}};
constexpr Region kDiffuseSphere = {"diffuse sphere", 0.80, 0.89, 0.56, 0.70};

/// Mean over a region of the absolute difference of two pictures.
double difference(const image::Image& a, const image::Image& b, const Region& region) {
    double sum = 0.0;
    int count = 0;
    for (int y = static_cast<int>(region.top * a.height); y < static_cast<int>(region.bottom * a.height); ++y)
        for (int x = static_cast<int>(region.left * a.width); x < static_cast<int>(region.right * a.width); ++x) {
            const std::size_t i = static_cast<std::size_t>(y * a.width + x);
            const glm::dvec3 d = glm::abs(glm::dvec3(a.texels[i]) - glm::dvec3(b.texels[i]));
            sum += (d.r + d.g + d.b) / 3.0;
            ++count;
        }
    return sum / count;
}

std::filesystem::path without_gratings(const std::filesystem::path& glb) {
    const std::vector<std::byte> bytes = read_file(glb, 1 << 26);
    std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string extension = "ROWLAND_materials_diffraction";
    const std::string unknown = "UNKNOWN_materials_diffraction";  // as long, so that the chunks keep their sizes
    for (std::size_t at = text.find(extension); at != std::string::npos; at = text.find(extension, at))
        text.replace(at, extension.size(), unknown);
    std::filesystem::path path = test::result("cabinet_without_gratings.glb");
    write_file_atomic(path, text);
    return path;
}

TEST(DemoCabinet, EveryGratingIsSeen) {
    const std::filesystem::path cooked = std::filesystem::path(ROWLAND_DEMO).parent_path() / "../cooked";
    const std::filesystem::path cabinet = cooked / "cabinet.scene";
    const auto in_the_studio = [&](const std::string& name, const std::filesystem::path& scene) {
        const std::string probe = " --probe " + (cooked / "studio.probe").string();
        return test::render(name, "--scene " + scene.string() + probe, 320, 180);
    };
    const image::Image picture = in_the_studio("cabinet", cabinet);
    const image::Image plain =
        in_the_studio("cabinet_plain", without_gratings(test::content_path("scenes/cabinet.glb")));
    ASSERT_EQ(picture.texels.size(), 320U * 180U);
    for (const glm::vec3& texel : picture.texels) {
        ASSERT_TRUE(std::isfinite(texel.r) && std::isfinite(texel.g) && std::isfinite(texel.b));
        // Spectral colours lie outside the working space: 495 nm is (-.35, 1, .84) there.
        const float largest = std::max({texel.r, texel.g, texel.b});
        ASSERT_GE(std::min({texel.r, texel.g, texel.b}), -0.36F * largest - 1e-3F);
    }
    // Measured: 0.028 for the record, which is nearly as grey without, and from 0.2 to 0.9 for the others.
    for (const Region& grating : kGratings) EXPECT_GT(difference(picture, plain, grating), 0.01) << grating.name;
    // Occlusion reads the depths of all objects, which two programs may round differently.
    EXPECT_LT(difference(picture, plain, kDiffuseSphere), 1e-6);
}

}  // namespace
}  // namespace rowland
