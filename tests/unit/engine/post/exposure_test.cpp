#include "tests/unit/engine/post/cpu_effects.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>

namespace rowland::post {

namespace {

TEST(Exposure, AStopIsAFactorOfTwo) {
    for (const auto& [stops, factor] : {std::pair{0.0F, 1.0F}, {3.0F, 8.0F}, {-2.0F, 0.25F}, {0.5F, 1.41421356F}}) {
        glm::vec3 pixel(1.0F);
        apply_exposure(std::span(&pixel, 1), stops);
        EXPECT_NEAR(pixel.g, factor, 1e-7F);
    }
}

TEST(Exposure, ScalesEveryComponentOfEitherSign) {
    std::array pixels{glm::vec3(1.0F, -2.0F, 0.0F), glm::vec3(1e4F, 1e-4F, 3.0F)};
    apply_exposure(pixels, 1.0F);
    EXPECT_EQ(pixels[0], glm::vec3(2.0F, -4.0F, 0.0F));
    EXPECT_EQ(pixels[1], glm::vec3(2e4F, 2e-4F, 6.0F));
}

}  // namespace

}  // namespace rowland::post
