#include "engine/post/vignette.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/engine/post/cpu_effects.h"

namespace rowland::post {

namespace {

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
