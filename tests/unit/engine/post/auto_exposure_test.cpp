#include "engine/post/auto_exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

}  // namespace

}  // namespace rowland::post
