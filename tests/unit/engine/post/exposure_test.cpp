#include "engine/post/exposure.h"

#include <gtest/gtest.h>

#include <array>

namespace rowland::post {

namespace {

TEST(Exposure, AStopIsAFactorOfTwo) {
    EXPECT_EQ(exposure_scale(0.0F), 1.0F);
    EXPECT_EQ(exposure_scale(3.0F), 8.0F);
    EXPECT_EQ(exposure_scale(-2.0F), 0.25F);
    EXPECT_NEAR(exposure_scale(0.5F), 1.41421356F, 1e-7F);
}

TEST(Exposure, ScalesEveryComponentOfEitherSign) {
    std::array pixels{glm::vec3(1.0F, -2.0F, 0.0F), glm::vec3(1e4F, 1e-4F, 3.0F)};
    apply_exposure(pixels, 1.0F);
    EXPECT_EQ(pixels[0], glm::vec3(2.0F, -4.0F, 0.0F));
    EXPECT_EQ(pixels[1], glm::vec3(2e4F, 2e-4F, 6.0F));
}

}  // namespace

}  // namespace rowland::post
