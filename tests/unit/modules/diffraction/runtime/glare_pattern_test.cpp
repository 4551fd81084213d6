#include "modules/diffraction/runtime/glare_pattern.h"

#include <gtest/gtest.h>

#include <numeric>

#include "engine/colour/colour_space.h"

namespace rowland::diffraction {
namespace {

/// The picture in Rec.709.
post::GlarePattern pattern_in_rec709(const Grating& grating) {
    return glare_pattern(grating, glm::inverse(colour::rec709_to_xyz()));
}

std::vector<int> orders_up_to(int highest) {
    std::vector<int> orders(static_cast<std::size_t>(2 * highest + 1));
    std::iota(orders.begin(), orders.end(), -highest);
    return orders;
}

TEST(GlarePattern, SlitsPassTheirWidthAndNoMore) {
    constexpr double kDuty = 0.8;
    const Grating door{.pitch_nm = 1e5, .profile = SlitProfile{.width_nm = kDuty * 1e5}, .orders = orders_up_to(60)};
    const post::GlarePattern pattern = pattern_in_rec709(door);
    glm::mat3 passed = pattern.straight;
    for (const auto& point : pattern.points) passed += point.weight;
    const glm::vec3 straight = pattern.straight * glm::vec3(1.0F);
    const glm::vec3 all = passed * glm::vec3(1.0F);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(straight[c], kDuty * kDuty, 2e-3) << c;
        // Orders beyond the sixtieth have 0.7 %.
        EXPECT_NEAR(all[c], kDuty, 0.012) << c;
        EXPECT_LE(all[c], kDuty);
    }
}

TEST(GlarePattern, APointIsWhereItsWavelengthIsSeen) {
    const Grating glasses{.pitch_nm = 2000.0, .profile = BlazedProfile{.depth_nm = 300.0}, .orders = {1}};
    const post::GlarePattern pattern = pattern_in_rec709(glasses);
    // s_g + v_g = λ/d; one sees light from s where −v points.
    EXPECT_FLOAT_EQ(pattern.points.front().offset.x, -380.0F / 2000.0F);
    EXPECT_FLOAT_EQ(pattern.points.back().offset.x, -780.0F / 2000.0F);
    glm::mat3 blue(0.0F);
    glm::mat3 red(0.0F);
    for (const auto& point : pattern.points) {
        EXPECT_EQ(point.offset.y, 0.0F);
        (point.offset.x > -0.24F ? blue : red) += point.weight;
    }
    const glm::vec3 inside = blue * glm::vec3(1.0F);
    const glm::vec3 outside = red * glm::vec3(1.0F);
    EXPECT_GT(inside.b, 2.0F * std::abs(inside.g));
    EXPECT_GT(outside.r, 2.0F * std::abs(outside.b));
}

TEST(GlarePattern, ALatticeHasPointsInBothDirections) {
    const Grating screen{.pitch_nm = 5e4,
                         .lattice = Lattice{.a_nm = {5e4, 0.0},
                                            .b_nm = {0.0, 6e4},
                                            .profile = ApertureProfile{.width_nm = 4e4, .height_nm = 4e4},
                                            .orders = 2}};
    const post::GlarePattern pattern = pattern_in_rec709(screen);
    glm::vec2 reach(0.0F);
    glm::mat3 passed = pattern.straight;
    for (const auto& point : pattern.points) {
        reach = glm::max(reach, glm::abs(point.offset));
        passed += point.weight;
    }
    EXPECT_NEAR(reach.x, 2.0 * 780.0 / 5e4, 1e-3);
    EXPECT_NEAR(reach.y, 2.0 * 780.0 / 6e4, 1e-3);
    const double area = 4.0 / 5.0 * 4.0 / 6.0;
    EXPECT_NEAR((pattern.straight * glm::vec3(1.0F)).g, area * area, 2e-3);
    EXPECT_LE((passed * glm::vec3(1.0F)).g, area);
}

}  // namespace
}  // namespace rowland::diffraction
