#include "editor/inspector/plot.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>

#include "editor/inspector/screen_colour.h"
#include "engine/colour/working_space.h"

namespace rowland::inspector {
namespace {

TEST(Plot, TicksAreRoundAndWithinTheAxis) {
    EXPECT_EQ(ticks({380.0, 780.0, ""}, 4), (std::vector<double>{400.0, 500.0, 600.0, 700.0}));
    EXPECT_EQ(ticks({-0.1, 0.1, ""}, 2), (std::vector<double>{-0.1, 0.0, 0.1}));
    EXPECT_EQ(ticks({0.5, 200.0, "", true}, 4), (std::vector<double>{1.0, 10.0, 100.0}));
    EXPECT_TRUE(ticks({1.0, 1.0, ""}, 4).empty());
}

TEST(Plot, SeriesHaveColoursOfTheirOwn) {
    std::set<ImU32> colours;
    for (std::size_t i = 0; i < 7; ++i) colours.insert(series_colour(i));
    EXPECT_EQ(colours.size(), 7U);
}

TEST(ScreenColour, WhiteIsWhiteAndNothingLeavesTheScreen) {
    const glm::vec3 white = screen_colour(colour::white_d65());
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(white[i], 1.0F, 1e-5F);
    for (const glm::dvec3 xyz : {glm::dvec3(0.0), glm::dvec3(5.0, 1.0, 0.0), glm::dvec3(0.0, 0.3, 0.0)}) {
        const glm::vec3 rgb = screen_colour(xyz);
        EXPECT_EQ(rgb, glm::clamp(rgb, 0.0F, 1.0F));
    }
    const glm::vec3 grey = screen_colour(0.2140 * colour::white_d65());  // sRGB's half
    EXPECT_NEAR(grey.g, 0.5F, 1e-3F);
}

}  // namespace
}  // namespace rowland::inspector
