#include "tests/unit/engine/scene/punctual_attenuation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rowland::scene {
namespace {

TEST(PunctualLight, WithoutRangeNothingIsLost) {
    EXPECT_EQ(attenuation({}, 1000.0F, 1.0F), 1.0F);
}

TEST(PunctualLight, RangeWindowEndsTheLight) {
    const PunctualLight light{.range_m = 2.0F};
    EXPECT_EQ(attenuation(light, 0.0F, -1.0F), 1.0F);
    EXPECT_FLOAT_EQ(attenuation(light, 1.0F, -1.0F), 0.9375F);  // 1 - (1/2)^4
    EXPECT_EQ(attenuation(light, 2.0F, -1.0F), 0.0F);
    EXPECT_EQ(attenuation(light, 50.0F, -1.0F), 0.0F);
}

TEST(PunctualLight, SpotFadesBetweenItsCones) {
    const PunctualLight light{.spot = true, .inner_cone = 0.3F, .outer_cone = 0.6F};
    EXPECT_EQ(attenuation(light, 1.0F, std::cos(0.2F)), 1.0F);
    EXPECT_EQ(attenuation(light, 1.0F, std::cos(0.7F)), 0.0F);
    const float middle = 0.5F * (std::cos(0.3F) + std::cos(0.6F));
    EXPECT_NEAR(attenuation(light, 1.0F, middle), 0.25F, 1e-6F);  // half of the way, squared; rounding
    EXPECT_EQ(attenuation(light, 1.0F, -1.0F), 0.0F);
}

TEST(PunctualLight, ConesOfOneAngleStillAnswer) {
    const PunctualLight light{.spot = true, .inner_cone = 0.5F, .outer_cone = 0.5F};
    EXPECT_EQ(attenuation(light, 1.0F, std::cos(0.4F)), 1.0F);
    EXPECT_EQ(attenuation(light, 1.0F, std::cos(0.6F)), 0.0F);
}

}  // namespace
}  // namespace rowland::scene
