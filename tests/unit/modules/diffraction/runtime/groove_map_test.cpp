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

TEST(GrooveMoments, AreThoseOfSixteenBitsWhereThePictureHasThem) {
    image::ByteImage image = grooves({{128, 128}});
    image.rgba16 = {32900, 32768, 0, 65535};
    const auto moments = groove_moments(image, {.even = false, .smallest_pitch = 2.0 * 32768 / 65535.0});
    EXPECT_NEAR(moments[0] / 65535.0, 0.5 + 0.5 * std::cos(3.14159265 * 32900 / 65535.0), 1e-5);
    EXPECT_EQ(moments[2], 65535);
    const GroovePitches pitches = groove_pitches(image);
    EXPECT_EQ(pitches.smallest, 2.0 * 32768 / 65535.0);
    // 16 bits whose upper 8 are 0 are a grating all the same.
    image.rgba = {128, 0, 0, 255};
    image.rgba16 = {32900, 90, 0, 65535};
    EXPECT_GT(groove_moments(image, {.smallest_pitch = 2.0 * 90 / 65535.0})[2], 0);
}

}  // namespace
}  // namespace rowland::diffraction
