#include "engine/render/probe_volumes.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/scalar_constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <random>
#include <vector>

namespace rowland::render {
namespace {

ProbeBox box(const glm::vec3& centre, const glm::vec3& half, float fade_m, float turn = 0.0F) {
    ProbeBox made{.fade_m = fade_m};
    made.box_to_world =
        glm::scale(glm::rotate(glm::translate(glm::mat4(1.0F), centre), turn, glm::vec3(0.0F, 1.0F, 0.0F)), half);
    made.world_to_box = glm::inverse(made.box_to_world);
    return made;
}

/// The parts of the frame's lights at a point.
std::vector<float> parts_at(const glm::vec3& point, const std::vector<ProbeBox>& boxes) {
    const LightMix mix = light_at(point, boxes);
    std::vector<float> parts(boxes.size() + 1, 0.0F);
    parts[mix.first] += 1.0F - mix.second_part;
    parts[mix.second] += mix.second_part;
    return parts;
}

TEST(ProbeVolumes, ABoxsWeightFallsOverItsFadeWhereverItsSidesPoint) {
    const ProbeBox turned = box({1.0F, 0.0F, 0.0F}, {2.0F, 1.0F, 0.5F}, 0.4F, glm::pi<float>() / 2.0F);
    // Its long side lies along z.
    EXPECT_EQ(turned.weight({1.0F, 0.9F, 1.9F}), 1.0F);
    EXPECT_NEAR(turned.weight({1.0F, 0.0F, 2.1F}), 0.75F, 1e-5F);
    EXPECT_NEAR(turned.weight({1.7F, 0.0F, 0.0F}), 0.5F, 1e-5F);
    EXPECT_EQ(turned.weight({2.0F, 0.0F, 0.0F}), 0.0F);
    EXPECT_NEAR(turned.volume_m3(), 8.0F, 1e-4F);
    const ProbeBox hard = box({0.0F, 0.0F, 0.0F}, glm::vec3(1.0F), 0.0F);
    EXPECT_EQ(hard.weight({1.0F, 0.0F, 0.0F}), 1.0F);
    EXPECT_EQ(hard.weight({1.001F, 0.0F, 0.0F}), 0.0F);
}

TEST(ProbeVolumes, WithoutABoxTheRenderersProbeLights) {
    EXPECT_FALSE(light_at({0.0F, 0.0F, 0.0F}, {}).is_local());
    EXPECT_FALSE(light_at({9.0F, 0.0F, 0.0F}, std::vector{box({}, glm::vec3(1.0F), 1.0F)}).is_local());
}

TEST(ProbeVolumes, ASmallerBoxComesFirstAndRoomsMeetAtTheDoor) {
    const std::vector<ProbeBox> boxes = {box({}, glm::vec3(4.0F), 1.0F), box({}, glm::vec3(1.0F), 1.0F)};
    EXPECT_EQ(parts_at({0.5F, 0.0F, 0.0F}, boxes), (std::vector<float>{0.0F, 0.0F, 1.0F}));
    EXPECT_EQ(parts_at({1.25F, 0.0F, 0.0F}, boxes), (std::vector<float>{0.0F, 0.25F, 0.75F}));
    EXPECT_EQ(parts_at({3.0F, 0.0F, 0.0F}, boxes), (std::vector<float>{0.0F, 1.0F, 0.0F}));
    EXPECT_EQ(parts_at({4.5F, 0.0F, 0.0F}, boxes), (std::vector<float>{0.5F, 0.5F, 0.0F}));
    const LightMix mix = light_at({1.25F, 0.0F, 0.0F}, boxes);
    EXPECT_LT(mix.first, mix.second);
}

/// However boxes overlap, the parts sum to 1, two of them at most, and a step of 2 mm changes them little.
TEST(ProbeVolumes, TheLightIsContinuousOverOverlappingBoxes) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    const auto vector = [&](float scale) {
        return scale * glm::vec3(uniform(random), uniform(random), uniform(random));
    };
    int blended = 0;
    int jumps_of_all = 0;
    for (int scene = 0; scene < 40; ++scene) {
        std::vector<ProbeBox> boxes;
        for (int i = 0; i < 5; ++i)
            boxes.push_back(box(vector(2.0F), glm::vec3(0.6F) + glm::abs(vector(1.5F)), 1.0F, uniform(random) * 3.0F));
        const glm::vec3 from = vector(4.0F);
        const glm::vec3 to = vector(4.0F);
        constexpr int kSteps = 4000;
        std::vector<float> before;
        int jumps = 0;
        for (int step = 0; step <= kSteps; ++step) {
            const glm::vec3 point = glm::mix(from, to, static_cast<float>(step) / kSteps);
            const std::vector<float> parts = parts_at(point, boxes);
            float sum = 0.0F;
            for (const float part : parts) sum += part;
            ASSERT_NEAR(sum, 1.0F, 1e-5F);
            const auto lit = std::ranges::count_if(parts, [](float part) { return part > 0.0F; });
            ASSERT_LE(lit, 2);
            blended += lit == 2 ? 1 : 0;
            float change = 0.0F;
            for (std::size_t i = 0; i < before.size(); ++i) change = std::max(change, std::abs(parts[i] - before[i]));
            jumps += change > 0.1F ? 1 : 0;
            before = parts;
        }
        jumps_of_all += jumps;
    }
    // Near points where three parts are equal.
    EXPECT_LE(jumps_of_all, 40 * 4000 / 10000);
    EXPECT_GT(blended, 1000);
}

}  // namespace
}  // namespace rowland::render
