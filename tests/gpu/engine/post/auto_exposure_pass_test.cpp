#include "engine/post/auto_exposure.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/post/shader_files.h"
#include "tests/gpu/gl_test.h"
#include "tests/unit/engine/post/cpu_effects.h"

namespace rowland {

namespace {

const glm::vec3 weights(0.272F, 0.674F, 0.054F);  // about those of ACEScg
constexpr float darkest = 1e-3F;

/// Colours from 1e-5 to 1e4, a few of them black, negative or not finite.
std::vector<glm::vec3> varied_picture(glm::ivec2 size) {
    std::mt19937 random(17);
    std::uniform_real_distribution<float> exponent(-5.0F, 4.0F);
    std::vector<glm::vec3> pixels(static_cast<std::size_t>(size.x * size.y));
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) pixels[i][c] = std::pow(10.0F, exponent(random));
        if (i % 7 == 3) pixels[i] = glm::vec3(0.0F);
        if (i % 11 == 5) pixels[i].g = -2.0F;
        if (i % 13 == 6) pixels[i].r = std::numeric_limits<float>::quiet_NaN();
        if (i % 17 == 9) pixels[i].b = std::numeric_limits<float>::infinity();
    }
    return pixels;
}

class AutoExposurePassTest : public test::GlTest {
 protected:
    AutoExposurePassTest() { library_.add_embedded(post::shader_files()); }

    static gpu::Texture picture(const std::vector<glm::vec3>& pixels, glm::ivec2 size) {
        gpu::Texture texture({.format = gpu::Format::RGBA32F, .width = size.x, .height = size.y});
        texture.upload(std::span<const glm::vec3>(pixels));
        return texture;
    }

    gpu::ShaderLibrary library_;
};

TEST_F(AutoExposurePassTest, AgreesWithTheCpu) {
    post::AutoExposurePass pass(library_);
    double worst = 0.0;
    for (const glm::ivec2 size : {glm::ivec2(640, 360), glm::ivec2(129, 65), glm::ivec2(3, 70), glm::ivec2(1, 1)}) {
        const std::vector<glm::vec3> pixels = varied_picture(size);
        const auto measured = pass.measure(picture(pixels, size), weights, darkest);
        ASSERT_TRUE(measured.has_value());
        const double expected = *post::mean_log2_luminance(pixels, weights, darkest);
        // The promise of the header: a thousandth of a stop, which no eye sees.
        EXPECT_NEAR(*measured, expected, 1e-3) << size.x;
        worst = std::max(worst, std::abs(*measured - expected));
    }
    RecordProperty("worst_stops", fmt::format("{}", worst));
}

TEST_F(AutoExposurePassTest, APictureOfNoNumbersHasNoLuminance) {
    post::AutoExposurePass pass(library_);
    const std::vector<glm::vec3> pixels(81, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    EXPECT_FALSE(pass.measure(picture(pixels, {9, 9}), weights, darkest).has_value());
}

TEST_F(AutoExposurePassTest, TakesOnePassPerFactorOfEight) {
    post::AutoExposurePass pass(library_);
    for (const auto& [size, passes] : {std::pair{glm::ivec2(1, 1), 1}, std::pair{glm::ivec2(8, 8), 1},
                                       std::pair{glm::ivec2(9, 1), 2}, std::pair{glm::ivec2(640, 360), 4}}) {
        (void)pass.measure(picture(varied_picture(size), size), weights, darkest);
        EXPECT_EQ(pass.passes(), passes) << size.x;
    }
}

}  // namespace

}  // namespace rowland
