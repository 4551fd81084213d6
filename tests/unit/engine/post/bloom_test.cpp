#include "engine/post/bloom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "tests/unit/engine/post/cpu_effects.h"

namespace rowland::post {

namespace {

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

}  // namespace

}  // namespace rowland::post
