#include <gtest/gtest.h>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/unit/content/demo/play/small_world.h"

namespace rowland::demo {

namespace {

double angle_of(const glm::dquat& q) {
    return 2.0 * std::atan2(glm::length(glm::dvec3(q.x, q.y, q.z)), std::abs(q.w));
}

Body thrown(double speed) {
    Body body;
    body.state.spin = {0.0, speed, 0.0};
    return body;
}

TEST(DemoBody, AThrownBodyTurnsBySpeedTimesDecayAndComesToRest) {
    // 1 rad/s for the decay's 2.5 s: 2.5 rad in all. What it no longer turns below its slowest speed is 1e-3 of that.
    Body body = thrown(1.0);
    for (int i = 0; i < 120 * 60; ++i) step(body, 1.0 / 120.0);
    EXPECT_NEAR(angle_of(body.state.turned), kSpinDecay_s, 3e-3);
    EXPECT_EQ(body.state.spin, glm::dvec3(0.0));
}

TEST(DemoBody, TheLengthOfStepsHardlyMatters) {
    Body fine = thrown(8.0);
    Body coarse = thrown(8.0);
    for (int i = 0; i < 240; ++i) step(fine, 1.0 / 240.0);
    for (int i = 0; i < 10; ++i) step(coarse, 1.0 / 10.0);
    // Both are exact; what differs is rounding.
    EXPECT_NEAR(glm::length(fine.state.spin - coarse.state.spin), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(glm::dot(fine.state.turned, coarse.state.turned)), 1.0, 1e-12);
    EXPECT_GT(angle_of(coarse.state.turned), 0.1);
}

TEST(DemoBody, ItTurnsByItselfUntilTouched) {
    Body body;
    body.spin_axis = {0.0F, 0.0F, 1.0F};
    body.idle_spin = 0.5;
    for (int i = 0; i < 120; ++i) step(body, 1.0 / 120.0);
    EXPECT_NEAR(angle_of(glm::dquat(transform_of(body, {0, 1, 0}).rotation)), 0.5, 1e-6);
    body.state.touched = true;
    for (int i = 0; i < 120; ++i) step(body, 1.0 / 120.0);
    EXPECT_NEAR(angle_of(glm::dquat(transform_of(body, {0, 1, 0}).rotation)), 0.5, 1e-6);
}

TEST(DemoBody, ItsCentreStaysWhereItWasHoweverItIsTurned) {
    Body body;
    body.rest = {.translation = {1.0F, 2.0F, 3.0F},
                 .rotation = glm::angleAxis(0.7F, glm::normalize(glm::vec3(1.0F, 2.0F, -1.0F))),
                 .scale = {1.0F, 2.0F, 0.5F}};
    body.centre = {0.3F, -0.2F, 0.4F};
    const auto centre_of = [&](const scene::Transform& at) {
        return glm::vec3(at.matrix() * glm::vec4(body.centre, 1.0F));
    };
    const glm::vec3 before = centre_of(transform_of(body, {0, 1, 0}));
    turn(body, glm::angleAxis(1.1, glm::normalize(glm::dvec3(0.2, 1.0, 0.4))));
    const scene::Transform turned = transform_of(body, {0, 1, 0});
    EXPECT_GT(glm::distance(turned.translation, body.rest.translation), 0.1F);
    EXPECT_NEAR(glm::distance(centre_of(turned), before), 0.0F, 1e-5F);
}

TEST(DemoBody, RaisedItRisesByItsClearanceAndComesDownAgain) {
    Body body;
    body.clearance = 0.2F;
    body.state.raised = true;
    for (int i = 0; i < 120 * 3; ++i) step_lift(body, 1.0 / 120.0);
    EXPECT_EQ(transform_of(body, {0.0F, 0.5F, 0.0F}).translation, glm::vec3(0.0F, 0.1F, 0.0F));
    body.state.raised = false;
    for (int i = 0; i < 120 * 3; ++i) step_lift(body, 1.0 / 120.0);
    EXPECT_EQ(transform_of(body, {0.0F, 0.5F, 0.0F}).translation, glm::vec3(0.0F));
}

}  // namespace

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
