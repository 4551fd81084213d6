// Each effect on the GPU against the CPU, and what it promises of energy, halves and bad numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/gpu/engine/post/post_test.h"
#include "tests/gpu/wide_halves.h"
#include "tests/unit/engine/post/cpu_effects.h"

namespace rowland {

namespace {

using post::BloomSettings;
using post::VignetteSettings;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

class AutoExposurePassTest : public test::PostTest {
 protected:
    /// Colours from 1e-5 to 1e4, a few of them black, negative or not finite.
    static std::vector<glm::vec3> varied_picture(glm::ivec2 size) {
        std::mt19937 random(17);
        std::uniform_real_distribution<float> exponent(-5.0F, 4.0F);
        std::vector<glm::vec3> pixels(count(size));
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            for (int c = 0; c < 3; ++c) pixels[i][c] = std::pow(10.0F, exponent(random));
            if (i % 7 == 3) pixels[i] = glm::vec3(0.0F);
            if (i % 11 == 5) pixels[i].g = -2.0F;
            if (i % 13 == 6) pixels[i].r = kNotANumber;
            if (i % 17 == 9) pixels[i].b = kInfinity;
        }
        return pixels;
    }
    post::MeanLog2Luminance measure(const std::vector<glm::vec3>& pixels, glm::ivec2 size) {
        pass_.start(picture(pixels, size), kWeights, kDarkest);
        return pass_.wait();
    }

    static constexpr glm::vec3 kWeights{0.272F, 0.674F, 0.054F};  // about those of ACEScg
    static constexpr float kDarkest = 1e-3F;
    post::AutoExposurePass pass_{library_};
};

TEST_F(AutoExposurePassTest, AgreesWithTheCpu) {
    for (const glm::ivec2 size : {glm::ivec2(640, 360), glm::ivec2(129, 65), glm::ivec2(3, 70), glm::ivec2(1, 1)}) {
        const std::vector<glm::vec3> pixels = varied_picture(size);
        const auto measured = measure(pixels, size);
        ASSERT_TRUE(measured.has_value());
        const double expected = *post::mean_log2_luminance(pixels, kWeights, kDarkest);
        // The promise of the header: a thousandth of a stop, which no eye sees.
        EXPECT_NEAR(*measured, expected, 1e-3) << size.x;
    }
}

TEST_F(AutoExposurePassTest, APictureOfNoNumbersHasNoLuminance) {
    EXPECT_FALSE(measure(std::vector<glm::vec3>(81, glm::vec3(kNotANumber)), {9, 9}).has_value());
}

TEST_F(AutoExposurePassTest, ResultsComeLateAndOnce) {
    const auto start = [&](float value) {
        pass_.start(picture(std::vector<glm::vec3>(9, glm::vec3(value)), {3, 3}), kWeights, kDarkest);
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

class BloomPassTest : public test::PostTest {
 protected:
    static std::vector<glm::vec4> random_picture(glm::ivec2 size) {
        std::mt19937 random(11);
        std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
        std::vector<glm::vec4> pixels(count(size));
        for (glm::vec4& pixel : pixels)
            for (int c = 0; c < 4; ++c) pixel[c] = uniform(random);
        return pixels;
    }
    std::vector<glm::vec4> draw(const std::vector<glm::vec4>& pixels, glm::ivec2 size, const BloomSettings& settings,
                                gpu::Format format) {
        const gpu::Framebuffer drawn = target(size, format);
        pass_.draw(picture(pixels, size), settings, drawn);
        return drawn.colour().read();
    }
    /// Expects the sum of each channel to stay within the header's promise: 1e-3 with all textures RGBA16F.
    void expect_light_kept(const std::vector<glm::vec4>& pixels, glm::ivec2 size, int levels) {
        const auto drawn = draw(pixels, size, {.strength = 1.0F, .levels = levels}, gpu::Format::RGBA16F);
        glm::dvec3 before(0.0);
        glm::dvec3 after(0.0);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            before += glm::dvec3(pixels[i]);
            after += glm::dvec3(drawn[i]);
        }
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c] / before[c], 1.0, 1e-3) << size.x << " " << levels;
    }

    post::BloomPass pass_{library_};
};

TEST_F(BloomPassTest, AgreesWithTheCpu) {
    for (const glm::ivec2 size : {glm::ivec2(64, 32), glm::ivec2(37, 23), glm::ivec2(5, 1), glm::ivec2(1, 1)}) {
        for (const int levels : {1, 3, 6}) {
            const BloomSettings settings{.strength = 0.75F, .levels = levels};
            const std::vector<glm::vec4> pixels = random_picture(size);
            std::vector<glm::vec3> expected(pixels.begin(), pixels.end());
            post::apply_bloom(expected, size, settings);
            const auto drawn = draw(pixels, size, settings, gpu::Format::RGBA32F);
            // Light and area are each rounded to halves (half a step: 2^-12 of a value) on the way down, values on the
            // way up; nothing is negative, so relative errors add at most.
            const float tolerance = 3.0F * static_cast<float>(levels) * std::exp2(-11.0F);
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(drawn[i][c], expected[i][c], tolerance * expected[i][c]) << size.x << " " << i;
                }
                EXPECT_EQ(drawn[i].a, pixels[i].a);
            }
        }
    }
}

TEST_F(BloomPassTest, KeepsTheLightInHalfFloats) {
    for (const int levels : {1, 4, 8}) expect_light_kept(random_picture({256, 128}), {256, 128}, levels);
    const glm::ivec2 size(201, 133);
    expect_light_kept(random_picture(size), size, 8);
    for (const glm::ivec2 place : {glm::ivec2(100, 60), glm::ivec2(0, 0), glm::ivec2(200, 132), glm::ivec2(199, 50)}) {
        SCOPED_TRACE(fmt::format("a bright pixel at {}, {}", place.x, place.y));
        std::vector<glm::vec4> pixels(count(size), glm::vec4(0.0F));
        pixels[static_cast<std::size_t>(place.y * size.x + place.x)] = glm::vec4(1e4F);
        expect_light_kept(pixels, size, 6);
    }
}

TEST_F(BloomPassTest, WhatIsNotFiniteDoesNotSpread) {
    const glm::ivec2 size(9, 9);
    std::vector<glm::vec4> bad(81, glm::vec4(1.0F));
    std::vector<glm::vec4> mended = bad;
    bad[40] = {kNotANumber, kInfinity, 1e9F, 1.0F};
    bad[3] = {glm::vec3(-kInfinity), 1.0F};
    mended[40] = {0.0F, 0.0F, 65504.0F, 1.0F};
    mended[3] = {0.0F, 0.0F, 0.0F, 1.0F};
    const auto drawn = draw(bad, size, {.strength = 0.5F}, gpu::Format::RGBA32F);
    EXPECT_EQ(drawn, draw(mended, size, {.strength = 0.5F}, gpu::Format::RGBA32F));
    for (const glm::vec4& pixel : drawn) EXPECT_LE(std::abs(pixel.r), 1.0F);
}

class NoisePassTest : public test::PostTest {
 protected:
    static constexpr glm::ivec2 kSize{256, 16};

    /// A slow gradient: four 8-bit steps over 256 pixels, that is one band per 64.
    static float gradient(int x) { return (80.0F + static_cast<float>(x) / 64.0F) / 255.0F; }
    static std::vector<glm::vec4> gradient_picture() {
        std::vector<glm::vec4> pixels;
        for (int y = 0; y < kSize.y; ++y)
            for (int x = 0; x < kSize.x; ++x) pixels.emplace_back(glm::vec3(gradient(x)), 0.4F);
        return pixels;
    }
    /// How far the mean over a square of the picture is from the gradient's at most, in 8-bit steps.
    static double worst_square(const std::vector<std::uint8_t>& bytes) {
        constexpr int kSide = 16;
        double worst = 0.0;
        for (int left = 0; left + kSide <= kSize.x; ++left) {
            double difference = 0.0;
            for (int y = 0; y < kSide; ++y)
                for (int x = left; x < left + kSide; ++x)
                    difference += bytes[static_cast<std::size_t>(4 * (y * kSize.x + x))] - 255.0 * gradient(x);
            worst = std::max(worst, std::abs(difference) / (kSide * kSide));
        }
        return worst;
    }

    gpu::Texture source_ = picture(gradient_picture(), kSize);
    post::NoisePass pass_{library_};
};

TEST_F(NoisePassTest, AgreesWithTheCpu) {
    const gpu::Framebuffer drawn_to = target(kSize);
    for (const std::uint32_t frame : {0U, 9U, 4000000000U}) {
        const std::vector<glm::vec4> pixels = gradient_picture();
        std::vector<glm::vec3> expected(pixels.begin(), pixels.end());
        post::apply_grain(expected, kSize, frame, {.strength = 0.1F});
        post::apply_dither(expected, kSize, frame, {.bits = 6});
        pass_.draw(source_, frame, post::DitherSettings{.bits = 6}, post::GrainSettings{.strength = 0.1F}, drawn_to);
        const std::vector<glm::vec4> drawn = drawn_to.colour().read();
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            EXPECT_NEAR(drawn[i].g, expected[i].g, 5e-6F) << i;  // a GPU's square root, times grain
            EXPECT_EQ(drawn[i].a, 0.4F);
        }
    }
}

TEST_F(NoisePassTest, AnEightBitGradientHasNoBands) {
    const gpu::Framebuffer bytes = target(kSize, gpu::Format::RGBA8);
    for (const std::uint32_t frame : {0U, 1U, 2U}) {
        pass_.draw(source_, frame, post::DitherSettings{}, {}, bytes);
        EXPECT_LE(worst_square(bytes.read_rgba8()), 0.1) << frame;  // of it a GPU's rounding to bytes: .02
    }
    // Noise so fine that it does nothing shows the bands: the measure can tell.
    pass_.draw(source_, 0, post::DitherSettings{.bits = 12}, {}, bytes);
    EXPECT_GT(worst_square(bytes.read_rgba8()), 0.25);
}

using VignettePassTest = test::PostTest;

TEST_F(VignettePassTest, AgreesWithTheFormula) {
    const post::VignettePass pass(library_);
    for (const glm::ivec2 size : {glm::ivec2(64, 36), glm::ivec2(33, 47)}) {
        const gpu::Texture source = picture(std::vector<glm::vec4>(count(size), {1.0F, -0.5F, 0.25F, 0.75F}), size);
        const gpu::Framebuffer drawn_to = target(size);
        for (const VignetteSettings& settings :
             {VignetteSettings{.vertical_fov = 1.2F}, VignetteSettings{.strength = 0.8F, .radius = 0.3F},
              VignetteSettings{.vertical_fov = 0.7F, .strength = 1.0F, .softness = 0.1F}, VignetteSettings{}}) {
            pass.draw(source, settings, drawn_to);
            const std::vector<glm::vec4> drawn = drawn_to.colour().read();
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const glm::vec4& pixel = drawn[static_cast<std::size_t>(y * size.x + x)];
                    const float factor = post::vignette_factor({x, y}, size, settings);
                    // Float rounding on either side, magnified by the steepest smoothstep, 1.5 / 0.1.
                    EXPECT_NEAR(pixel.r, factor, 1e-5F) << x << " " << y;
                    EXPECT_NEAR(pixel.g, -0.5F * factor, 1e-5F);
                    EXPECT_EQ(pixel.a, 0.75F);
                }
        }
    }
}

class HalfFloatPassTest : public BloomPassTest {
 protected:
    /// Expects a pass to leave nothing for the driver to round.
    template <typename Draw>
    void expect_rounded(const Draw& draw) const {
        const test::WideHalves wide;
        const gpu::Framebuffer halves = target(kSize, gpu::Format::RGBA16F);
        draw(halves);
        EXPECT_EQ(test::not_halves(halves.read_rgba_float()), 0);
        const gpu::Framebuffer floats = target(kSize);
        draw(floats);
        EXPECT_GT(test::not_halves(floats.read_rgba_float()), kSize.x * kSize.y);
    }

    static constexpr glm::ivec2 kSize{16, 16};
    gpu::Texture source_ = picture(random_picture(kSize), kSize);
};

TEST_F(HalfFloatPassTest, BloomAndVignetteRound) {
    expect_rounded([&](const gpu::Framebuffer& drawn) { pass_.draw(source_, {.strength = 0.3F}, drawn); });
    const post::VignettePass vignette(library_);
    expect_rounded([&](const gpu::Framebuffer& drawn) { vignette.draw(source_, {.vertical_fov = 1.0F}, drawn); });
}

}  // namespace

}  // namespace rowland
