#include "content/demo/play/pick.h"
#include "content/demo/play/hierarchy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/scene/transform.h"
#include "tests/unit/content/demo/play/small_world.h"

namespace rowland::demo {
namespace {

// Places are floats of size 1 m; chains of a few operations keep them to some 1e-6 m.
constexpr float kRounding = 1e-5F;

TEST(DemoPick, ARayGoesThroughThePixelItWasMadeFor) {
    const scene::Camera camera{.eye = {1.0F, 2.0F, 3.0F}, .target = {0.2F, -0.3F, 0.1F}};
    const glm::ivec2 size(640, 360);
    for (const glm::dvec2 place : {glm::dvec2(320, 180), glm::dvec2(10, 20), glm::dvec2(600, 350)}) {
        const Ray ray = ray_through(camera, place, size);
        EXPECT_NEAR(glm::length(ray.direction), 1.0F, kRounding);
        const glm::vec4 clip =
            camera.projection(640.0F / 360.0F) * camera.view() * glm::vec4(ray.origin + 2.0F * ray.direction, 1.0F);
        EXPECT_NEAR((clip.x / clip.w * 0.5F + 0.5F) * 640.0F, place.x, 0.01);
        EXPECT_NEAR((0.5F - clip.y / clip.w * 0.5F) * 360.0F, place.y, 0.01);
    }
}

TEST(DemoPick, TheNearestOfTwoIsHitAtItsPlaceInTheWorld) {
    ecs::World world;
    std::vector<PickTarget> targets;
    for (const float z : {-2.0F, -1.0F}) {
        const ecs::Entity entity = world.create();
        world.add(entity, scene::Transform{.translation = {0.0F, 0.0F, z}, .scale = glm::vec3(3.0F)});
        targets.push_back({entity, test::square(), scene::bounds(*test::square())});
    }
    const auto hit = pick(world, targets, {{0.2F, 0.1F, 1.0F}, {0.0F, 0.0F, -1.0F}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->target, 1U);
    EXPECT_NEAR(hit->triangle.distance, 2.0F, kRounding);
    EXPECT_NEAR(glm::distance(hit->point, glm::vec3(0.2F, 0.1F, -1.0F)), 0.0F, kRounding);
    // (0.2, 0.1) / 3 lies in the triangle below the diagonal; it is the weighted mean of the corners.
    EXPECT_EQ(hit->triangle.triangle, 0U);
    const auto& corners = targets[1].mesh->positions;
    const glm::vec2 weights = hit->triangle.weights;
    const glm::vec3 mean =
        (1.0F - weights.x - weights.y) * corners[0] + weights.x * corners[1] + weights.y * corners[2];
    EXPECT_NEAR(glm::distance(3.0F * mean, glm::vec3(0.2F, 0.1F, 0.0F)), 0.0F, kRounding);
}

TEST(DemoPick, ARayBesideOrAwayHitsNothing) {
    ecs::World world;
    const ecs::Entity entity = world.create();
    world.add(entity, scene::Transform{});
    const std::vector<PickTarget> targets{{entity, test::square(), scene::bounds(*test::square())}};
    EXPECT_TRUE(pick(world, targets, {{0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -1.0F}}));
    EXPECT_FALSE(pick(world, targets, {{0.11F, 0.0F, 1.0F}, {0.0F, 0.0F, -1.0F}}));
    EXPECT_FALSE(pick(world, targets, {{0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 1.0F}}));
    world.destroy(entity);
    EXPECT_FALSE(pick(world, targets, {{0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -1.0F}}));
}

TEST(DemoPick, PlacementFollowsTheChainOfParents) {
    test::SmallWorld small;
    scene::update_world_matrices(small.world);
    for (const ecs::Entity entity : {small.root, small.stand, small.left, small.right})
        EXPECT_EQ(object_to_world(small.world, entity), small.world.get<scene::WorldMatrix>(entity).matrix);
}

}  // namespace
}  // namespace rowland::demo
