// The demo's pictures against committed ones. `./rowland update-golden` renders the committed ones again; look
// at them before you commit.
#include <gtest/gtest.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/image/byte_image.h"
#include "engine/image/image.h"
#include "tests/demo/demo_run.h"

namespace rowland {
namespace {

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

Picture read_png(const std::filesystem::path& path) {
    Picture picture;
    int channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load(path.string().c_str(), &picture.width, &picture.height, &channels, 3), &stbi_image_free);
    if (pixels) picture.rgb.assign(pixels.get(), pixels.get() + std::ptrdiff_t{3} * picture.width * picture.height);
    return picture;
}

int run_demo(const std::string& arguments) {
    return test::run_demo("--disc --width 480 --height 270 " + arguments);
}

std::string cooked_probe(const std::string& name) {
    return (std::filesystem::path(ROWLAND_DEMO).parent_path().parent_path() / "cooked" / (name + ".probe")).string();
}

// On one driver the pictures are equal to the byte. Drivers differ in triangle edges and in texture filtering: a mean
// of half a step, and one pixel in 200 by more than 8 steps, are allowed; a wrong order, sign or scale moves far more.
constexpr double kLargestMean = 0.5;
constexpr int kLargeDifference = 8;
constexpr double kLargestFraction = 0.005;

void expect_equal(const Picture& drawn, const Picture& golden) {
    ASSERT_EQ(drawn.width, golden.width);
    ASSERT_EQ(drawn.height, golden.height);
    double sum = 0.0;
    std::size_t large = 0;
    for (std::size_t i = 0; i < drawn.rgb.size(); ++i) {
        const int difference = std::abs(int{drawn.rgb[i]} - int{golden.rgb[i]});
        sum += difference;
        large += difference > kLargeDifference ? 1U : 0U;
    }
    const auto count = static_cast<double>(drawn.rgb.size());
    EXPECT_LT(sum / count, kLargestMean);
    EXPECT_LT(static_cast<double>(large) / count, kLargestFraction);
}

void check_golden(const std::string& probe) {
    const std::filesystem::path golden = std::filesystem::path(ROWLAND_GOLDEN_FOLDER) / ("cd_" + probe + ".png");
    const std::filesystem::path drawn = std::filesystem::path(ROWLAND_RESULT_FOLDER) / ("cd_" + probe + ".png");
    const bool update = std::getenv("ROWLAND_UPDATE_GOLDEN") != nullptr;
    ASSERT_EQ(run_demo("--probe " + cooked_probe(probe) + " --capture " + (update ? golden : drawn).string()), 0);
    if (update) GTEST_SKIP() << "rendered again: " << golden;
    SCOPED_TRACE("compare " + drawn.string() + " with " + golden.string());
    expect_equal(read_png(drawn), read_png(golden));
}

TEST(Golden, CdInTheStudio) {
    check_golden("studio");
}
TEST(Golden, CdUnderTheClearSky) {
    check_golden("clear_sky");
}

TEST(Golden, TheComparisonSeesAChangeOfOneFifthOfAStop) {
    const std::filesystem::path folder = ROWLAND_RESULT_FOLDER;
    const std::filesystem::path drawn = folder / "cd_studio_brighter.png";
    ASSERT_EQ(run_demo("--probe " + cooked_probe("studio") + " --exposure 0.2 --capture " + drawn.string()), 0);
    const Picture brighter = read_png(drawn);
    const Picture golden = read_png(std::filesystem::path(ROWLAND_GOLDEN_FOLDER) / "cd_studio.png");
    ASSERT_EQ(brighter.rgb.size(), golden.rgb.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < golden.rgb.size(); ++i) sum += std::abs(int{brighter.rgb[i]} - int{golden.rgb[i]});
    EXPECT_GT(sum / static_cast<double>(golden.rgb.size()), 2.0 * kLargestMean);
}

TEST(Golden, LinearCaptureHoldsFinitePixelsOnly) {
    const std::filesystem::path drawn = std::filesystem::path(ROWLAND_RESULT_FOLDER) / "cd_clear_sky.exr";
    ASSERT_EQ(run_demo("--probe " + cooked_probe("clear_sky") + " --capture-linear " + drawn.string()), 0);
    const image::Image image = image::load_image(drawn);
    EXPECT_EQ(image.width, 480);
    EXPECT_EQ(image.height, 270);
    for (const glm::vec3& texel : image.texels)
        ASSERT_TRUE(std::isfinite(texel.r) && std::isfinite(texel.g) && std::isfinite(texel.b));
}

}  // namespace
}  // namespace rowland
