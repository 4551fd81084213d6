#include "engine/colour/primaries.h"

#include <gtest/gtest.h>

namespace rowland::colour {
namespace {

/// ACES AP1 with its white (about D60) [S-2014-004].
constexpr Primaries kAcesCg{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}};

TEST(Primaries, Rec709NeedsNoConversion) {
    EXPECT_FALSE(to_rec709(kRec709).has_value());
    Primaries rounded = kRec709;
    rounded.white = {0.3127, 0.3291};
    EXPECT_FALSE(to_rec709(rounded).has_value());
}

TEST(Primaries, AcesCgToRec709IsThePublishedMatrix) {
    // The ACES project's AP1 → Rec.709/D65 with Bradford adaptation, as printed to five digits.
    const double expected[3][3] = {
        {1.70505, -0.62179, -0.08326}, {-0.13026, 1.14080, -0.01055}, {-0.02400, -0.12897, 1.15297}};
    const auto matrix = to_rec709(kAcesCg);
    ASSERT_TRUE(matrix.has_value());
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            EXPECT_NEAR((*matrix)[column][row], expected[row][column], 2e-4) << row << ", " << column;
}

TEST(Primaries, WhiteOfD65IsWhite) {
    const glm::dvec3 white = xyz_to_rec709() * xy_to_xyz(kRec709.white);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1, 1e-12);
}

TEST(Primaries, WhiteStaysWhite) {
    const glm::dvec3 white = *to_rec709(kAcesCg) * glm::dvec3(1.0);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1, 1e-12);
}

TEST(Primaries, DegenerateOnesAreNotUsable) {
    EXPECT_TRUE(is_usable(kAcesCg));
    EXPECT_FALSE(is_usable({{0.3, 0.3}, {0.4, 0.4}, {0.5, 0.5}, {0.3, 0.3}}));
    Primaries dark = kRec709;
    dark.white.y = 0;
    EXPECT_FALSE(is_usable(dark));
}

}  // namespace
}  // namespace rowland::colour
