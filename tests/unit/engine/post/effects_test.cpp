// Effects on the CPU: what the GPU's are compared with.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "engine/post/auto_exposure.h"
#include "engine/post/bloom.h"
#include "engine/post/vignette.h"
#include "tests/unit/engine/post/cpu_effects.h"

namespace rowland::post {

namespace {

const glm::vec3 kWeights(0.25F, 0.625F, 0.125F);

/// Black and negative light count as the darkest, light that is not finite does not count.
TEST(AutoExposure, AveragesTheLogarithmOfLuminance) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
    const std::array pixels{
        glm::vec3(infinity), glm::vec3(0.5F),  glm::vec3(8.0F, 0.0F, 0.0F),        glm::vec3(0.0F, 0.0F, 64.0F),
        glm::vec3(0.0F),     glm::vec3(-1.0F), glm::vec3(not_a_number, 1.0F, 1.0F)};
    // log2 of 0.5, 2, 8 and twice of 0.25.
    EXPECT_NEAR(*mean_log2_luminance(pixels, kWeights, 0.25F), (-1.0 + 1.0 + 3.0 - 2.0 - 2.0) / 5.0, 1e-12);
    EXPECT_FALSE(mean_log2_luminance(std::span(pixels).first(1), kWeights, 1e-4F).has_value());
    EXPECT_FALSE(mean_log2_luminance({}, kWeights, 1e-4F).has_value());
}

TEST(AutoExposure, BringsTheAverageToTheKey) {
    const float stops = target_stops(std::log2(1.44), {});
    EXPECT_NEAR(stops, -3.0F, 1e-6F);  // 1.44 = 8 · 0.18
    EXPECT_NEAR(target_stops(std::log2(1.44), {.key = 0.36F}), -2.0F, 1e-6F);
    EXPECT_EQ(target_stops(20.0, {.min_stops = -5.0F}), -5.0F);
    EXPECT_EQ(target_stops(-20.0, {.max_stops = 6.0F}), 6.0F);
}

TEST(AutoExposure, TwoHalfStepsAreOneWholeStep) {
    const AutoExposureSettings settings;
    for (const float target : {-3.0F, 5.0F}) {
        const float whole = adapted_stops(1.0F, target, 0.5F, settings);
        const float half = adapted_stops(1.0F, target, 0.25F, settings);
        EXPECT_NEAR(adapted_stops(half, target, 0.25F, settings), whole, 1e-6F);  // float rounding
        EXPECT_NE(whole, 1.0F);
        EXPECT_NE(whole, target);
    }
}

TEST(AutoExposure, RisesAndFallsEachAtItsSpeed) {
    const AutoExposureSettings settings{.speed_up = 2.0F, .speed_down = 6.0F};
    EXPECT_NEAR(adapted_stops(0.0F, 1.0F, 0.5F, settings), 1.0F - std::exp(-1.0F), 1e-6F);
    EXPECT_NEAR(adapted_stops(1.0F, 0.0F, 0.5F, settings), std::exp(-3.0F), 1e-6F);
    EXPECT_EQ(adapted_stops(0.7F, 3.0F, 0.0F, settings), 0.7F);
    EXPECT_NEAR(adapted_stops(0.7F, 3.0F, 100.0F, settings), 3.0F, 1e-6F);
}

TEST(AutoExposureDeathTest, SettingsOutOfRangeAreALogicError) {
    EXPECT_DEATH(require_valid(AutoExposureSettings{.key = 0.0F}), "settings.key > 0");
    EXPECT_DEATH(require_valid(AutoExposureSettings{.min_stops = 2.0F, .max_stops = 1.0F}), "settings.min_stops <=");
    EXPECT_DEATH((void)adapted_stops(0.0F, 1.0F, -0.1F, {}), "seconds >= 0");
}

const std::vector<glm::ivec2> sizes{{1, 1}, {1, 7}, {2, 1}, {5, 2}, {37, 23}, {64, 32}, {31, 33}};

std::size_t count(glm::ivec2 size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
}

std::vector<glm::vec3> random_picture(glm::ivec2 size) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    std::vector<glm::vec3> pixels(count(size));
    for (glm::vec3& pixel : pixels) {
        for (int c = 0; c < 3; ++c) pixel[c] = uniform(random);
    }
    return pixels;
}

glm::dvec3 sum(const std::vector<glm::vec3>& pixels) {
    return std::accumulate(pixels.begin(), pixels.end(), glm::dvec3(0.0),
                           [](const glm::dvec3& total, const glm::vec3& pixel) { return total + glm::dvec3(pixel); });
}

/// A row of black with one pixel of 1, wholly blurred.
std::vector<glm::vec3> blurred_point(int width, std::size_t place, int levels) {
    std::vector<glm::vec3> pixels(static_cast<std::size_t>(width), glm::vec3(0.0F));
    pixels[place] = glm::vec3(1.0F);
    apply_bloom(pixels, {width, 1}, {.strength = 1.0F, .levels = levels});
    return pixels;
}

TEST(Bloom, KeepsTheLightOfARandomPictureUpToItsBorders) {
    for (const glm::ivec2 size : sizes) {
        for (const int levels : {1, 2, 3, 8}) {
            std::vector<glm::vec3> pixels = random_picture(size);
            const glm::dvec3 before = sum(pixels);
            apply_bloom(pixels, size, {.strength = 1.0F, .levels = levels});
            // Some tens of float roundings per pixel, each 6e-8.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(sum(pixels)[c], before[c], 3e-6 * before[c]) << size.x << " " << levels;
        }
    }
}

TEST(Bloom, KeepsTheLightOfAPointWhereverItIs) {
    for (const int width : {1, 2, 3, 5, 11, 16}) {
        for (int place = 0; place < width; ++place) {
            const auto pixels = blurred_point(width, static_cast<std::size_t>(place), 4);
            EXPECT_NEAR(sum(pixels).r, 1.0, 3e-6) << width << " " << place;  // as above
        }
    }
}

TEST(Bloom, LeavesAPictureOfOneColourAsItIs) {
    for (const glm::ivec2 size : sizes) {
        std::vector<glm::vec3> pixels(count(size), glm::vec3(0.3F, 2.0F, -7.0F));
        apply_bloom(pixels, size, {.strength = 1.0F, .levels = 8});
        for (const glm::vec3& pixel : pixels) {
            EXPECT_NEAR(pixel.r, 0.3F, 1e-6F);  // a few roundings
            EXPECT_NEAR(pixel.b, -7.0F, 2e-5F);
        }
    }
}

TEST(Bloom, OneLevelSpreadsAPointByChaikinsWeights) {
    const std::vector<glm::vec3> pixels = blurred_point(8, 2, 1);
    // Down: 1/8 and 3/8 reach the first two texels; up: 3/4 of the nearer, 1/4 of the other.
    const std::vector<float> expected{0.125F, 0.1875F, 0.3125F, 0.28125F, 0.09375F, 0.0F, 0.0F, 0.0F};
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(pixels[i].g, expected[i]) << i;
}

TEST(Bloom, EveryLevelSpreadsFurther) {
    const auto variance = [](int levels) {
        const auto pixels = blurred_point(256, 128, levels);
        double second = 0.0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const double distance = static_cast<double>(i) - 128.0;
            second += distance * distance * pixels[i].r;
        }
        return second;
    };
    EXPECT_GT(variance(1), 0.5);
    for (int levels = 2; levels <= 5; ++levels) EXPECT_GT(variance(levels), 1.5 * variance(levels - 1)) << levels;
}

TEST(Bloom, LevelsShareEvenly) {
    EXPECT_FLOAT_EQ(bloom_coarser_weight(0, 3), 2.0F / 3.0F);
    EXPECT_FLOAT_EQ(bloom_coarser_weight(1, 3), 1.0F / 2.0F);
    EXPECT_EQ(bloom_coarser_weight(2, 3), 0.0F);
}

TEST(Bloom, LevelsRoundUpAndStopAtOneTexel) {
    EXPECT_EQ(bloom_level_sizes({5, 2}, 8), (std::vector<glm::ivec2>{{3, 1}, {2, 1}, {1, 1}}));
    EXPECT_EQ(bloom_level_sizes({5, 2}, 2), (std::vector<glm::ivec2>{{3, 1}, {2, 1}}));
    EXPECT_EQ(bloom_level_sizes({1, 1}, 8), (std::vector<glm::ivec2>{{1, 1}}));
}

TEST(Bloom, StrengthIsTheShareOfTheBlurredPicture) {
    const glm::ivec2 size(19, 12);
    const std::vector<glm::vec3> picture = random_picture(size);
    std::vector<glm::vec3> blurred = picture;
    apply_bloom(blurred, size, {.strength = 1.0F, .levels = 3});
    std::vector<glm::vec3> mixed = picture;
    apply_bloom(mixed, size, {.strength = 0.25F, .levels = 3});
    for (std::size_t i = 0; i < picture.size(); ++i) {
        EXPECT_NEAR(mixed[i].g, 0.75F * picture[i].g + 0.25F * blurred[i].g, 1e-6F);  // rounding
    }
    std::vector<glm::vec3> untouched = picture;
    apply_bloom(untouched, size, {.strength = 0.0F});
    EXPECT_EQ(untouched, picture);
}

TEST(BloomDeathTest, SettingsOutOfRangeAreALogicError) {
    std::vector<glm::vec3> pixels(4);
    EXPECT_DEATH(apply_bloom(pixels, {2, 2}, {.strength = 1.5F}), "settings.strength <= 1");
    EXPECT_DEATH(apply_bloom(pixels, {2, 2}, {.levels = 0}), "settings.levels >= 1");
    EXPECT_DEATH(apply_bloom(pixels, {2, 3}, {}), "pixels.size");
}

constexpr float right_angle = 1.57079633F;

TEST(Vignette, NaturalOneFallsByTheFourthPowerOfTheCosine) {
    // With a field of view of 90° the picture's upper edge is 45° off the axis: cos⁴ = 1/4. Pixel centres are half a
    // pixel inside, so take a picture with a pixel centre at (0, h/2 - 1/2).
    const glm::ivec2 size(1, 101);
    const VignetteSettings settings{.vertical_fov = right_angle};
    const double angle = std::atan(50.0 / 50.5);
    EXPECT_NEAR(vignette_factor({0, 100}, size, settings), std::pow(std::cos(angle), 4.0), 1e-6);  // float rounding
    EXPECT_EQ(vignette_factor({0, 50}, size, settings), 1.0F);
    EXPECT_EQ(vignette_factor({0, 0}, size, settings), vignette_factor({0, 100}, size, settings));
}

TEST(Vignette, NaturalOneDependsOnTheAngleNotOnTheAspect) {
    const VignetteSettings settings{.vertical_fov = 1.0F};
    // 30 pixels off the axis to the right and upwards, in pictures of the same height.
    const float upwards = vignette_factor({50, 80}, {101, 101}, settings);
    EXPECT_NEAR(vignette_factor({130, 50}, {201, 101}, settings), upwards, 1e-6F);
    EXPECT_LT(upwards, 0.95F);
}

TEST(Vignette, TasteBeginsAtItsRadiusAndLosesItsStrength) {
    const glm::ivec2 size(401, 301);  // half the diagonal is 250.7 pixels
    const VignetteSettings settings{.strength = 0.8F, .radius = 0.4F, .softness = 0.4F};
    EXPECT_EQ(vignette_factor({200, 150}, size, settings), 1.0F);
    EXPECT_EQ(vignette_factor({200 + 99, 150}, size, settings), 1.0F);  // 0.395
    EXPECT_LT(vignette_factor({200 + 110, 150}, size, settings), 1.0F);
    EXPECT_NEAR(vignette_factor({0, 0}, size, settings), 0.2F, 1e-6F);
    // Half way, at 0.6 · 250.7 = 150.4 pixels; its slope there is 0.8 · 1.5 / 0.4 per 250.7 pixels.
    EXPECT_NEAR(vignette_factor({200, 300}, size, settings), 0.6F + 0.4F * 0.012F, 1e-3F);
}

TEST(Vignette, BothMultiply) {
    const glm::ivec2 size(64, 48);
    const VignetteSettings natural{.vertical_fov = 1.2F};
    const VignetteSettings taste{.strength = 0.5F};
    const VignetteSettings both{.vertical_fov = 1.2F, .strength = 0.5F};
    const float product = vignette_factor({3, 5}, size, natural) * vignette_factor({3, 5}, size, taste);
    EXPECT_NEAR(vignette_factor({3, 5}, size, both), product, 1e-7F);
    EXPECT_LT(product, vignette_factor({3, 5}, size, natural));
}

TEST(Vignette, HasNoEffectUnlessAskedFor) {
    EXPECT_FALSE(has_effect(VignetteSettings{}));
    EXPECT_TRUE(has_effect(VignetteSettings{.vertical_fov = 1.0F}));
    EXPECT_TRUE(has_effect(VignetteSettings{.strength = 0.1F}));
    EXPECT_EQ(vignette_factor({0, 0}, {64, 48}, {}), 1.0F);
}

TEST(VignetteDeathTest, SettingsOutOfRangeAreALogicError) {
    EXPECT_DEATH(require_valid(VignetteSettings{.vertical_fov = 3.2F}), "fov <");
    EXPECT_DEATH(require_valid(VignetteSettings{.strength = 1.1F}), "settings.strength <= 1");
    EXPECT_DEATH(require_valid(VignetteSettings{.softness = 0.0F}), "settings.softness > 0");
}

}  // namespace

}  // namespace rowland::post
