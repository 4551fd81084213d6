#include "engine/render/world_bounds.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <vector>

#include "engine/scene/camera.h"

namespace rowland::render {
namespace {

std::array<glm::vec3, 8> corners(const scene::Bounds& box) {
    std::array<glm::vec3, 8> result;
    for (std::size_t i = 0; i < 8; ++i)
        result[i] = {(i & 1U) ? box.maximum.x : box.minimum.x, (i & 2U) ? box.maximum.y : box.minimum.y,
                     (i & 4U) ? box.maximum.z : box.minimum.z};
    return result;
}

glm::mat4 random_matrix(std::mt19937& random) {
    std::uniform_real_distribution<float> uniform(-2.0F, 2.0F);
    glm::mat4 matrix(1.0F);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) matrix[c][r] = uniform(random);
    return matrix;
}

TEST(WorldBounds, TransformedBoxIsTheTightestAroundTheCorners) {
    std::mt19937 random(1);
    for (int i = 0; i < 50; ++i) {
        const scene::Bounds box{{-1.0F, 0.5F, -3.0F}, {2.0F, 0.75F, 1.0F}};
        const glm::mat4 matrix = random_matrix(random);
        scene::Bounds expected{glm::vec3(1e9F), glm::vec3(-1e9F)};
        for (const glm::vec3& corner : corners(box)) {
            const glm::vec3 moved(matrix * glm::vec4(corner, 1.0F));
            expected = {glm::min(expected.minimum, moved), glm::max(expected.maximum, moved)};
        }
        const scene::Bounds found = transformed(box, matrix);
        for (int axis = 0; axis < 3; ++axis) {  // a few additions of numbers around 10
            EXPECT_NEAR(found.minimum[axis], expected.minimum[axis], 1e-5F);
            EXPECT_NEAR(found.maximum[axis], expected.maximum[axis], 1e-5F);
        }
    }
}

TEST(WorldBounds, UnitedHoldsAllAndNothingOfNothing) {
    EXPECT_FALSE(united({}).has_value());
    const std::vector<scene::Bounds> boxes = {{{0, 0, 0}, {1, 1, 1}}, {{-2, 0.5F, 0}, {-1, 3, 0.5F}}};
    const scene::Bounds all = united(boxes).value();
    EXPECT_EQ(all.minimum, glm::vec3(-2, 0, 0));
    EXPECT_EQ(all.maximum, glm::vec3(1, 3, 1));
}

TEST(WorldBounds, PosedBoundsHoldEveryBlendOfTheJoints) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    const scene::Bounds box{{-1.0F, -1.0F, 0.0F}, {1.0F, 2.0F, 1.0F}};
    const std::vector<glm::mat4> joints = {random_matrix(random), random_matrix(random), random_matrix(random)};
    const scene::Bounds posed = posed_bounds(box, joints);
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 vertex =
            glm::mix(box.minimum, box.maximum, glm::vec3(unit(random), unit(random), unit(random)));
        glm::vec3 weights(unit(random), unit(random), unit(random));
        weights /= weights.x + weights.y + weights.z;
        glm::vec3 moved(0.0F);
        for (int j = 0; j < 3; ++j)
            moved += weights[j] * glm::vec3(joints[static_cast<std::size_t>(j)] * glm::vec4(vertex, 1.0F));
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(moved[axis], posed.minimum[axis] - 1e-5F);
            EXPECT_LE(moved[axis], posed.maximum[axis] + 1e-5F);
        }
    }
}

TEST(Frustum, NeverHidesABoxWithAPointInView) {
    const scene::Camera camera{.eye = {1.0F, 2.0F, 5.0F}, .target = {0.0F, 0.5F, 0.0F}, .far_plane = 20.0F};
    const glm::mat4 view_projection = camera.projection(1.6F) * camera.view();
    const Frustum frustum(view_projection);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-12.0F, 12.0F);
    int seen = 0;
    int hidden = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 centre(uniform(random), uniform(random), uniform(random));
        const scene::Bounds box{centre - 0.7F, centre + 0.7F};
        const glm::vec4 clip = view_projection * glm::vec4(centre, 1.0F);
        const bool in_view = glm::all(glm::lessThanEqual(glm::abs(glm::vec3(clip)), glm::vec3(clip.w)));
        EXPECT_TRUE(frustum.may_see(box) || !in_view);
        seen += in_view ? 1 : 0;
        hidden += frustum.may_see(box) ? 0 : 1;
    }
    EXPECT_GT(seen, 100);
    EXPECT_GT(hidden, 1000);
}

TEST(Frustum, HidesWhatIsBeyondEachPlane) {
    const scene::Camera camera{.eye = {0.0F, 0.0F, 0.0F},
                               .target = {0.0F, 0.0F, -1.0F},
                               .vertical_field_of_view = 1.5707963F,
                               .near_plane = 1.0F,
                               .far_plane = 10.0F};
    const Frustum frustum(camera.projection(1.0F) * camera.view());
    const auto sees = [&](const glm::vec3& centre) { return frustum.may_see({centre - 0.1F, centre + 0.1F}); };
    EXPECT_TRUE(sees({0.0F, 0.0F, -5.0F}));
    EXPECT_TRUE(sees({5.05F, 0.0F, -5.0F}));  // across the right plane
    EXPECT_FALSE(sees({5.5F, 0.0F, -5.0F}));
    EXPECT_FALSE(sees({-5.5F, 0.0F, -5.0F}));
    EXPECT_FALSE(sees({0.0F, 5.5F, -5.0F}));
    EXPECT_FALSE(sees({0.0F, -5.5F, -5.0F}));
    EXPECT_FALSE(sees({0.0F, 0.0F, -0.5F}));
    EXPECT_FALSE(sees({0.0F, 0.0F, -11.0F}));
    EXPECT_FALSE(sees({0.0F, 0.0F, 5.0F}));
}

}  // namespace
}  // namespace rowland::render
