#include "engine/scene/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace rowland::scene {
namespace {

glm::vec3 position(ecs::World& world, ecs::Entity entity) {
    return glm::vec3(world.get<WorldMatrix>(entity).matrix[3]);
}

ecs::Entity add(ecs::World& world, const glm::vec3& translation) {
    const ecs::Entity entity = world.create();
    world.add(entity, Transform{.translation = translation});
    return entity;
}

TEST(Transform, ParentsApplyWhateverTheOrderOfCreation) {
    ecs::World world;
    const ecs::Entity child = add(world, {1.0F, 0.0F, 0.0F});
    const ecs::Entity parent = add(world, {0.0F, 2.0F, 0.0F});
    const ecs::Entity root = add(world, {0.0F, 0.0F, 3.0F});
    world.get<Transform>(root).scale = glm::vec3(2.0F);
    world.add(child, Parent{parent});
    world.add(parent, Parent{root});
    update_world_matrices(world);
    EXPECT_EQ(position(world, child), glm::vec3(2.0F, 4.0F, 3.0F));
    EXPECT_EQ(position(world, parent), glm::vec3(0.0F, 4.0F, 3.0F));
    EXPECT_EQ(position(world, root), glm::vec3(0.0F, 0.0F, 3.0F));
    // And again, as the next frame does.
    world.get<Transform>(root).translation.z = 5.0F;
    update_world_matrices(world);
    EXPECT_EQ(position(world, child), glm::vec3(2.0F, 4.0F, 5.0F));
}

TEST(Transform, ParentWithoutTransformPassesItsOwnParentOn) {
    ecs::World world;
    const ecs::Entity root = add(world, {1.0F, 0.0F, 0.0F});
    const ecs::Entity group = world.create();
    world.add(group, Parent{root});
    const ecs::Entity a = add(world, {0.0F, 1.0F, 0.0F});
    const ecs::Entity b = add(world, {0.0F, 2.0F, 0.0F});
    world.add(a, Parent{group});
    world.add(b, Parent{group});
    update_world_matrices(world);
    EXPECT_EQ(position(world, a), glm::vec3(1.0F, 1.0F, 0.0F));
    EXPECT_EQ(position(world, b), glm::vec3(1.0F, 2.0F, 0.0F));
    EXPECT_EQ(world.find<WorldMatrix>(group), nullptr);
}

TEST(Transform, DeadParentCountsAsNone) {
    ecs::World world;
    const ecs::Entity parent = add(world, {1.0F, 0.0F, 0.0F});
    const ecs::Entity child = add(world, {0.0F, 1.0F, 0.0F});
    world.add(child, Parent{parent});
    world.destroy(parent);
    update_world_matrices(world);
    EXPECT_EQ(position(world, child), glm::vec3(0.0F, 1.0F, 0.0F));
}

TEST(Transform, ChainOfAnyDepthIsPlacedOncePerEntity) {
    ecs::World world;
    constexpr int kLength = 100'000;
    ecs::Entity last = add(world, {1.0F, 0.0F, 0.0F});
    for (int i = 1; i < kLength; ++i) {
        const ecs::Entity next = add(world, {1.0F, 0.0F, 0.0F});
        world.add(next, Parent{last});
        last = next;
    }
    // Quadratic work, 5e9 products, would run into the test's time limit.
    update_world_matrices(world);
    EXPECT_EQ(position(world, last).x, static_cast<float>(kLength));
}

TEST(TransformDeathTest, CycleIsALogicError) {
    ecs::World world;
    const ecs::Entity a = add(world, {});
    const ecs::Entity b = add(world, {});
    world.add(a, Parent{b});
    world.add(b, Parent{a});
    EXPECT_DEATH(update_world_matrices(world), "cycle");
}

float largest_difference(const glm::mat4& a, const glm::mat4& b) {
    float largest = 0.0F;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) largest = std::max(largest, std::abs(a[column][row] - b[column][row]));
    return largest;
}

TEST(Decompose, PartsMakeTheMatrixAgain) {
    const glm::dquat turn = glm::angleAxis(2.1, glm::normalize(glm::dvec3(1.0, -2.0, 0.5)));
    for (const glm::dvec3 scale :
         {glm::dvec3(1.0), glm::dvec3(0.01, 3.0, 7.0), glm::dvec3(-2.0, 1.0, 0.5), glm::dvec3(-1.0, -1.0, -1.0),
          glm::dvec3(1.0, 0.0, 2.0), glm::dvec3(0.0, 0.0, 2.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0)}) {
        const glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), glm::dvec3(4.0, 5.0, -6.0)) * glm::mat4_cast(turn) *
                                  glm::scale(glm::dmat4(1.0), scale);
        const Decomposition parts = decompose(matrix);
        EXPECT_FALSE(parts.sheared);
        // Rounding of floats up to 7.
        EXPECT_LT(largest_difference(parts.transform.matrix(), glm::mat4(matrix)), 4e-6F) << scale.x << " " << scale.y;
        EXPECT_NEAR(glm::length(parts.transform.rotation), 1.0F, 1e-6F);
    }
}

TEST(Decompose, ShearIsReportedAndLost) {
    glm::dmat4 matrix(1.0);
    matrix[1][0] = 0.5;
    const Decomposition parts = decompose(matrix);
    EXPECT_TRUE(parts.sheared);
    EXPECT_NEAR(glm::length(parts.transform.rotation), 1.0F, 1e-6F);
    EXPECT_EQ(parts.transform.scale.x, 1.0F);
    matrix[1][0] = 1e-7;  // rounding
    EXPECT_FALSE(decompose(matrix).sheared);
}

}  // namespace
}  // namespace rowland::scene
