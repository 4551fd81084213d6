#include <gtest/gtest.h>
#include <cmath>

#include "modules/diffraction/runtime/groove_map.h"

namespace rowland::diffraction {
namespace {

/// Red and green of each texel.
image::ByteImage grooves(const std::vector<std::pair<int, int>>& texels) {
    image::ByteImage image;
    image.width = static_cast<int>(texels.size());
    image.height = 1;
    for (const auto& [red, green] : texels)
        for (const int byte : {red, green, 0, 255}) image.rgba.push_back(static_cast<std::uint8_t>(byte));
    return image;
}

TEST(GrooveMoments, HoldTheDirectionTwiceTurnedForEvenKernels) {
    const auto moments = groove_moments(grooves({{51, 100}, {255, 100}}), {.smallest_pitch = 200.0 / 255.0});
    ASSERT_EQ(moments.size(), 8U);
    EXPECT_NEAR(moments[0] / 65535.0, 0.5 + 0.5 * std::cos(2.0 * 0.2 * 3.14159265), 1e-5);
    EXPECT_NEAR(moments[1] / 65535.0, 0.5 + 0.5 * std::sin(2.0 * 0.2 * 3.14159265), 1e-5);
    EXPECT_EQ(moments[2], 65535);
    EXPECT_EQ(moments[3], 65535);
    EXPECT_EQ(moments[4], 65535) << "grooves turned by pi are the same";
}

TEST(GrooveMoments, KeepOppositeDirectionsApartForOtherKernels) {
    const auto moments =
        groove_moments(grooves({{0, 100}, {255, 100}}), {.even = false, .smallest_pitch = 200.0 / 255.0});
    EXPECT_EQ(moments[0], 65535);
    EXPECT_EQ(moments[4], 0);
}

TEST(GrooveMoments, HoldThePitchInverseAndItsSquare) {
    const auto moments = groove_moments(grooves({{0, 200}}), {.smallest_pitch = 200.0 / 255.0});
    EXPECT_NEAR(moments[2] / 65535.0, 0.5, 1e-5);
    EXPECT_NEAR(moments[3] / 65535.0, 0.25, 1e-5);
}

TEST(GrooveMoments, HoldTheCoverageWhereThereAreGaps) {
    const auto moments = groove_moments(grooves({{40, 0}, {40, 200}}), {.gaps = true, .smallest_pitch = 400.0 / 255.0});
    EXPECT_EQ(moments[2], 0);
    EXPECT_EQ(moments[3], 0);
    EXPECT_NEAR(moments[0] / 65535.0, 0.5, 1e-5);
    EXPECT_EQ(moments[7], 65535);
}

}  // namespace
}  // namespace rowland::diffraction
