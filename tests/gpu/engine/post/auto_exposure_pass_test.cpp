#include "engine/post/auto_exposure.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/post/post_stack.h"
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
    static gpu::Texture picture(const std::vector<glm::vec3>& pixels, glm::ivec2 size) {
        gpu::Texture texture({.format = gpu::Format::RGBA32F, .width = size.x, .height = size.y});
        texture.upload(std::span<const glm::vec3>(pixels));
        return texture;
    }

    /// Of one picture.
    post::MeanLuminance measure(const std::vector<glm::vec3>& pixels, glm::ivec2 size) {
        pass_.start(picture(pixels, size), weights, darkest);
        return pass_.wait();
    }

    gpu::ShaderLibrary library_ = [] {
        gpu::ShaderLibrary library;
        library.add_embedded(post::shader_files());
        return library;
    }();
    post::AutoExposurePass pass_{library_};
};

TEST_F(AutoExposurePassTest, AgreesWithTheCpu) {
    double worst = 0.0;
    for (const glm::ivec2 size : {glm::ivec2(640, 360), glm::ivec2(129, 65), glm::ivec2(3, 70), glm::ivec2(1, 1)}) {
        const std::vector<glm::vec3> pixels = varied_picture(size);
        const auto measured = measure(pixels, size);
        ASSERT_TRUE(measured.has_value());
        const double expected = *post::mean_log2_luminance(pixels, weights, darkest);
        // The promise of the header: a thousandth of a stop, which no eye sees.
        EXPECT_NEAR(*measured, expected, 1e-3) << size.x;
        worst = std::max(worst, std::abs(*measured - expected));
    }
    RecordProperty("worst_stops", fmt::format("{}", worst));
}

TEST_F(AutoExposurePassTest, APictureOfNoNumbersHasNoLuminance) {
    const std::vector<glm::vec3> pixels(81, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    EXPECT_FALSE(measure(pixels, {9, 9}).has_value());
}

TEST_F(AutoExposurePassTest, ResultsComeLateAndOnce) {
    const auto start = [&](float value) {
        pass_.start(picture(std::vector<glm::vec3>(9, glm::vec3(value)), {3, 3}), weights, darkest);
    };
    EXPECT_FALSE(pass_.take().has_value());
    for (int round = 0; round < 5; ++round) {
        start(0.25F);
        start(1.0F);
        glFinish();
        const auto newest = pass_.take();
        ASSERT_TRUE(newest.has_value() && newest->has_value());
        EXPECT_NEAR(**newest, 0.0, 1e-3);
        EXPECT_FALSE(pass_.take().has_value()) << "the older one is out of date";
    }
    // More than may be under way.
    for (int i = 0; i < 7; ++i) start(i == 6 ? 4.0F : 0.5F);
    EXPECT_NEAR(*pass_.wait(), 2.0, 1e-3);
}

TEST_F(AutoExposurePassTest, TakesOnePassPerFactorOfEight) {
    for (const auto& [size, passes] : {std::pair{glm::ivec2(1, 1), 1}, std::pair{glm::ivec2(8, 8), 1},
                                       std::pair{glm::ivec2(9, 1), 2}, std::pair{glm::ivec2(640, 360), 4}}) {
        (void)measure(varied_picture(size), size);
        EXPECT_EQ(pass_.passes(), passes) << size.x;
    }
}

}  // namespace

}  // namespace rowland
