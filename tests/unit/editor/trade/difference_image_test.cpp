#include "editor/trade/difference_image.h"

#include <gtest/gtest.h>

#include "engine/colour/working_space.h"

namespace rowland::trade {
namespace {

std::vector<glm::dvec3> flat(double y) {
    return std::vector<glm::dvec3>(6, y * colour::white_d65());
}

/// The pixel of a panel (0, 1, 2) of 3 × 2 pixels.
glm::ivec3 pixel(const RgbPicture& picture, int panel, int column, int row, int magnified) {
    const int x = (panel * (3 + 2) + column) * magnified;
    const auto at = static_cast<std::size_t>(3 * (row * magnified * picture.width + x));
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

TEST(DifferenceImage, EqualPicturesHaveABlackDifference) {
    const RgbPicture shown = difference_image(flat(0.3), flat(0.3), 3, 2, 4);
    EXPECT_EQ(shown.width, (3 * 3 + 2 * 2) * 4);
    EXPECT_EQ(shown.height, 8);
    EXPECT_EQ(shown.rgb.size(), static_cast<std::size_t>(3 * shown.width * shown.height));
    EXPECT_EQ(pixel(shown, 0, 1, 1, 4), pixel(shown, 1, 1, 1, 4));
    EXPECT_GT(pixel(shown, 0, 1, 1, 4).g, 50);
    EXPECT_EQ(pixel(shown, 2, 1, 1, 4), glm::ivec3(0));
}

TEST(DifferenceImage, OnlyThePixelThatDiffersIsLit) {
    std::vector<glm::dvec3> other = flat(0.3);
    other[4] *= 20.0;
    const RgbPicture shown = difference_image(other, flat(0.3), 3, 2, 1);
    EXPECT_GT(pixel(shown, 0, 1, 1, 1).g, pixel(shown, 1, 1, 1, 1).g);
    EXPECT_GT(pixel(shown, 2, 1, 1, 1).r, 200) << "far beyond the end of the scale: yellow";
    EXPECT_EQ(pixel(shown, 2, 0, 0, 1), glm::ivec3(0));
}

TEST(DifferenceImage, TheScaleGrowsLighter) {
    double last = -1.0;
    for (int i = 0; i <= 20; ++i) {
        const glm::vec3 c = difference_colour(i / 20.0);
        const double luma =
            0.2126 * static_cast<double>(c.r) + 0.7152 * static_cast<double>(c.g) + 0.0722 * static_cast<double>(c.b);
        EXPECT_GT(luma, last) << i;
        last = luma;
    }
    EXPECT_EQ(difference_colour(3.0), difference_colour(1.0));
}

}  // namespace
}  // namespace rowland::trade
