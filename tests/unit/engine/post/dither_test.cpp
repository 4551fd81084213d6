#include "engine/post/dither.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/unit/engine/post/cpu_effects.h"

namespace rowland::post {

namespace {

/// What an 8-bit target holds, in its steps.
float stored(float value) {
    return std::round(255.0F * std::min(std::max(value, 0.0F), 1.0F));
}

/// The mean of a dithered picture of one value, in 8-bit steps.
double mean_stored(float value, glm::ivec2 size, std::uint32_t frame) {
    std::vector<glm::vec3> pixels(static_cast<std::size_t>(size.x * size.y), glm::vec3(value));
    apply_dither(pixels, size, frame, {});
    double sum = 0.0;
    for (const glm::vec3& pixel : pixels) sum += stored(pixel.g);
    return sum / static_cast<double>(pixels.size());
}

TEST(Dither, TheMeanOverAnAreaIsTheValue) {
    for (const std::uint32_t frame : {0U, 1U, 77U}) {
        for (float steps = 10.0F; steps <= 11.0F; steps += 0.03125F) {
            // 0.05 of a step: a band is visible from about ten times that.
            EXPECT_NEAR(mean_stored(steps / 255.0F, {16, 16}, frame), steps, 0.05) << frame;
        }
    }
}

TEST(Dither, TheMeanOverFramesIsTheValue) {
    for (const float steps : {100.25F, 100.5F, 100.9F}) {
        double sum = 0.0;
        for (std::uint32_t frame = 0; frame < 64; ++frame) sum += mean_stored(steps / 255.0F, {1, 1}, frame);
        EXPECT_NEAR(sum / 64.0, steps, 0.05);
    }
}

TEST(Dither, BlackAndWhiteStayAsTheyAre) {
    EXPECT_EQ(mean_stored(0.0F, {64, 64}, 3), 0.0);
    EXPECT_EQ(mean_stored(1.0F, {64, 64}, 3), 255.0);
}

TEST(Dither, NoiseStaysWithinHalfAStepAndFillsIt) {
    float lowest = 0.0F;
    float highest = 0.0F;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            lowest = std::min(lowest, dither_offset({x, y}, 5));
            highest = std::max(highest, dither_offset({x, y}, 5));
        }
    }
    EXPECT_GT(lowest, -0.5F);
    EXPECT_LT(highest, 0.5F);
    EXPECT_LT(lowest, -0.49F);
    EXPECT_GT(highest, 0.49F);
}

TEST(Dither, SameForTheSameFrameAndOtherForAnother) {
    EXPECT_EQ(dither_offset({123, 45}, 6), dither_offset({123, 45}, 6));
    EXPECT_NE(dither_offset({123, 45}, 6), dither_offset({123, 45}, 7));
    EXPECT_NE(dither_offset({123, 45}, 6), dither_offset({124, 45}, 6));
    EXPECT_NE(dither_offset({123, 45}, 6), dither_offset({123, 46}, 6));
}

TEST(Dither, StepsFollowTheTargetsBits) {
    EXPECT_FLOAT_EQ(dither_step({}), 1.0F / 255.0F);
    EXPECT_FLOAT_EQ(dither_step({.bits = 10}), 1.0F / 1023.0F);
}

TEST(DitherDeathTest, BitsOutOfRangeAreALogicError) {
    EXPECT_DEATH((void)dither_step({.bits = 0}), "settings.bits >= 1");
    EXPECT_DEATH((void)dither_step({.bits = 13}), "settings.bits <= 12");
}

}  // namespace

}  // namespace rowland::post
