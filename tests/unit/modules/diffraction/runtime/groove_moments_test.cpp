#include "modules/diffraction/runtime/groove_moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "modules/diffraction/asset/groove_pitches.h"

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

using Texel = std::array<std::uint16_t, 4>;

Texel texel(const std::vector<std::uint16_t>& moments, std::size_t index) {
    Texel result{};
    std::copy_n(moments.begin() + static_cast<std::ptrdiff_t>(4 * index), 4, result.begin());
    return result;
}

TEST(GrooveFacets, ALevelHoldsOneOfFourAsOftenAsOthers) {
    constexpr std::array<int, 4> kReds = {10, 60, 120, 200};
    constexpr int kSide = 64;
    std::vector<std::pair<int, int>> texels;
    for (int i = 0; i < kSide * kSide; ++i)
        texels.emplace_back(kReds.at(static_cast<std::size_t>(2 * (i / kSide % 2) + i % 2)), 128);
    const auto moments = groove_moments(grooves(texels), {.smallest_pitch = 256.0 / 255.0});
    const auto level = facets_of_level(moments, {kSide, kSide}, false);
    ASSERT_EQ(4 * level.size(), moments.size());
    std::array<std::size_t, 4> found{};
    for (std::size_t i = 0; i < level.size() / 4; ++i)
        for (std::size_t k = 0; k < 4; ++k)
            if (texel(level, i) == texel(moments, k / 2 * kSide + k % 2)) ++found.at(k);
    EXPECT_EQ(found[0] + found[1] + found[2] + found[3], level.size() / 4);
    for (const std::size_t times : found) EXPECT_NEAR(static_cast<double>(times), 256.0, 4.0 * std::sqrt(192.0));
}

TEST(GrooveFacets, ALevelHoldsTheGroovesThatThereAreAndTheMeanCoverage) {
    const auto moments = groove_moments(grooves({{40, 0}, {90, 200}, {40, 0}, {40, 0}}),
                                        {.gaps = true, .smallest_pitch = 400.0 / 255.0});
    const Texel one = texel(facets_of_level(moments, {2, 2}, true), 0);
    for (std::size_t c = 0; c < 2; ++c)
        EXPECT_NEAR(one.at(c) - 32767.5, (texel(moments, 1).at(c) - 32767.5) / 4.0, 1.0) << c;
    EXPECT_NEAR(one[2], 65535.0 / 4.0, 1.0);
    EXPECT_NEAR(one[3], 65535.0 / 4.0, 1.0);
    EXPECT_EQ(texel(facets_of_level(groove_moments(grooves({{40, 0}}), {.gaps = true}), {1, 1}, true), 0)[2], 0);
}

TEST(GrooveFacets, TheirMeanAreaIsThatOfTheirSteps) {
    std::vector<std::pair<int, int>> texels;
    for (int row = 0; row < 12; ++row)
        for (int column = 0; column < 12; ++column) texels.emplace_back(40 * (column / 3) + 9 * (row / 4), 128);
    image::ByteImage image = grooves(texels);
    image.width = image.height = 12;
    // Three steps in eleven pairs of a row, two in a column.
    EXPECT_NEAR(facet_texels(image), (11.0 / 3.0) * (11.0 / 2.0), 1e-9);
}

}  // namespace
}  // namespace rowland::diffraction
