#include "engine/scene/animation.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>

#include "engine/scene/mesh_recipe.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

constexpr float kSqrtHalf = 0.70710678F;
// A quaternion's components are rounded once to float on the way in and once on the way out.
constexpr float kRounding = 2e-7F;

AnimationChannel channel(Interpolation interpolation, AnimatedProperty property = AnimatedProperty::Translation) {
    AnimationChannel channel;
    channel.property = property;
    channel.interpolation = interpolation;
    return channel;
}

AnimationChannel steps(Interpolation interpolation) {
    AnimationChannel moved = channel(interpolation);
    moved.times_s = {1.0F, 2.0F, 4.0F};
    moved.values = {{1, 2, 3, 0}, {3, 4, 5, 0}, {-1, 0, 1, 0}};
    return moved;
}

TEST(Animation, KeysAreHitAndTheirEndsHeld) {
    for (const Interpolation interpolation : {Interpolation::Step, Interpolation::Linear}) {
        const AnimationChannel moved = steps(interpolation);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(sample(moved, moved.times_s[i]), moved.values[i]);
        EXPECT_EQ(sample(moved, -1e30F), moved.values[0]);
        EXPECT_EQ(sample(moved, 1e30F), moved.values[2]);
        EXPECT_EQ(sample(moved, std::numeric_limits<float>::quiet_NaN()), moved.values[0]);
    }
}

TEST(Animation, StepHoldsUntilTheNextKey) {
    const AnimationChannel moved = steps(Interpolation::Step);
    EXPECT_EQ(sample(moved, 1.999F), moved.values[0]);
    EXPECT_EQ(sample(moved, 3.999F), moved.values[1]);
}

TEST(Animation, LinearIsTheShareOfTheWay) {
    const AnimationChannel moved = steps(Interpolation::Linear);
    EXPECT_EQ(sample(moved, 1.25F), glm::vec4(1.5F, 2.5F, 3.5F, 0.0F));
    EXPECT_EQ(sample(moved, 3.0F), glm::vec4(1.0F, 2.0F, 3.0F, 0.0F));
}

TEST(Animation, RotationTurnsEvenlyByTheShortestArc) {
    AnimationChannel turned = channel(Interpolation::Linear, AnimatedProperty::Rotation);
    turned.times_s = {0.0F, 1.0F};
    // No turn, and a quarter turn about Y in both of its signs.
    for (const float sign : {1.0F, -1.0F}) {
        turned.values = {{0, 0, 0, 1}, {0, sign * kSqrtHalf, 0, sign * kSqrtHalf}};
        for (const float time_s : {0.0F, 0.25F, 0.5F, 0.9F, 1.0F}) {
            glm::vec4 q = sample(turned, time_s);
            if (q.w < 0.0F) q = -q;
            const float half_angle = time_s * std::numbers::pi_v<float> / 4.0F;
            EXPECT_NEAR(q.y, std::sin(half_angle), kRounding);
            EXPECT_NEAR(q.w, std::cos(half_angle), kRounding);
            EXPECT_NEAR(glm::length(q), 1.0F, kRounding);
        }
    }
}

TEST(Animation, NearlyEqualRotationsStayUnit) {
    AnimationChannel turned = channel(Interpolation::Linear, AnimatedProperty::Rotation);
    turned.times_s = {0.0F, 1.0F};
    turned.values = {{0, 0, 0, 1}, {0, 1e-8F, 0, 1}};
    EXPECT_NEAR(glm::length(sample(turned, 0.5F)), 1.0F, kRounding);
    turned.values = {{0, 0, 0, 1}, {0, 0, 0, 1}};
    EXPECT_EQ(sample(turned, 0.5F), glm::vec4(0, 0, 0, 1));
    turned.values = {{0, 0, 0, 0}, {0, 0, 0, 0}};
    EXPECT_EQ(sample(turned, 0.5F), glm::vec4(0, 0, 0, 1));
}

TEST(Animation, CubicSplineReproducesACubic) {
    // x(t) = t³ - 2t + 1 is its own Hermite spline whatever the keys; its slope is 3t² - 2.
    const auto x = [](float t) { return t * t * t - 2.0F * t + 1.0F; };
    const auto slope = [](float t) { return 3.0F * t * t - 2.0F; };
    AnimationChannel moved = channel(Interpolation::CubicSpline);
    for (const float t : {-1.0F, 0.5F, 2.0F}) {
        moved.times_s.push_back(t);
        for (const float value : {slope(t), x(t), slope(t)}) moved.values.emplace_back(value, 2.0F * value, 0.0F, 0.0F);
    }
    for (float t = -1.0F; t <= 2.0F; t += 0.125F) {
        EXPECT_NEAR(sample(moved, t).x, x(t), 1e-6F) << t;  // a few roundings of values up to 5
        EXPECT_NEAR(sample(moved, t).y, 2.0F * x(t), 2e-6F) << t;
    }
    EXPECT_EQ(sample(moved, -5.0F).x, x(-1.0F));
    EXPECT_EQ(sample(moved, 5.0F).x, x(2.0F));
}

TEST(Animation, CubicSplineUsesOutTangentOfTheFirstAndInTangentOfTheSecondKey) {
    AnimationChannel moved = channel(Interpolation::CubicSpline);
    moved.times_s = {0.0F, 2.0F};
    moved.values.assign(6, glm::vec4(0.0F));
    moved.values[0].x = 100.0F;  // in-tangent of the first key: unused
    moved.values[5].x = 100.0F;  // out-tangent of the last key: unused
    moved.values[2].x = 1.0F;
    moved.values[3].y = 1.0F;
    // At the middle the tangents' weights are 1/8 and -1/8, times the 2 s between the keys.
    EXPECT_EQ(sample(moved, 1.0F), glm::vec4(0.25F, -0.25F, 0.0F, 0.0F));
}

TEST(Animation, CubicRotationsAreUnit) {
    AnimationChannel turned = channel(Interpolation::CubicSpline, AnimatedProperty::Rotation);
    turned.times_s = {0.0F, 1.0F};
    turned.values = {{}, {0, 0, 0, 1}, {0, 1, 0, 0}, {0, 1, 0, 0}, {0, kSqrtHalf, 0, kSqrtHalf}, {}};
    for (const float t : {0.1F, 0.5F, 0.7F}) EXPECT_NEAR(glm::length(sample(turned, t)), 1.0F, kRounding);
}

TEST(Animation, SplineBeyondTheRangeOfFloatsStaysFinite) {
    constexpr float kHuge = std::numeric_limits<float>::max();
    AnimationChannel moved = channel(Interpolation::CubicSpline);
    moved.times_s = {0.0F, 1e30F};
    moved.values.assign(6, glm::vec4(kHuge));
    EXPECT_TRUE(std::isfinite(sample(moved, 3e29F).x));
}

TEST(Animation, PoseWritesOnlyWhatTheAnimationMoves) {
    Animation animation;
    animation.channels.push_back(steps(Interpolation::Linear));
    animation.channels.back().node = 1;
    AnimationChannel scaled = steps(Interpolation::Linear);
    scaled.property = AnimatedProperty::Scale;
    scaled.node = 2;
    animation.channels.push_back(scaled);
    AnimationChannel turned = channel(Interpolation::Step, AnimatedProperty::Rotation);
    turned.times_s = {0.0F};
    turned.values = {{kSqrtHalf, 0, 0, kSqrtHalf}};
    turned.node = 2;
    animation.channels.push_back(turned);

    std::vector<Transform> nodes(3);
    for (Transform& node : nodes) node.translation = glm::vec3(9.0F);
    pose(animation, 1.25F, nodes);
    EXPECT_EQ(nodes[0].translation, glm::vec3(9.0F));
    EXPECT_EQ(nodes[0].scale, glm::vec3(1.0F));
    EXPECT_EQ(nodes[1].translation, glm::vec3(1.5F, 2.5F, 3.5F));
    EXPECT_EQ(nodes[1].scale, glm::vec3(1.0F));
    EXPECT_EQ(nodes[2].translation, glm::vec3(9.0F));
    EXPECT_EQ(nodes[2].scale, glm::vec3(1.5F, 2.5F, 3.5F));
    EXPECT_NEAR(nodes[2].rotation.x, kSqrtHalf, kRounding);
    EXPECT_NEAR(nodes[2].rotation.w, kSqrtHalf, kRounding);
}

TEST(AnimationDeathTest, ChannelOfAMissingNodeIsALogicError) {
    Animation animation;
    animation.channels.push_back(steps(Interpolation::Linear));
    animation.channels.back().node = 3;
    std::vector<Transform> nodes(3);
    EXPECT_DEATH(pose(animation, 0.0F, nodes), "channel.node < nodes.size");
}

constexpr float kQuarterTurn = 1.57079633F;

/// A strip along +Y in the XY plane, normal +Z: below the elbow at y = 1 it follows joint 0, above joint 1, at the
/// elbow both.
Mesh arm() {
    Mesh mesh;
    for (const float y : {0.0F, 1.0F, 2.0F}) {
        for (const float x : {0.0F, 1.0F}) {
            mesh.positions.emplace_back(x, y, 0.0F);
            mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
            mesh.tangents.emplace_back(1.0F, 0.0F, 0.0F, 1.0F);
            mesh.uvs.emplace_back(x, y);
            mesh.joints.emplace_back(0, 1, 0, 0);
            const float upper = y / 2.0F;
            mesh.weights.emplace_back(1.0F - upper, upper, 0.0F, 0.0F);
        }
    }
    mesh.indices = {0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4};
    return mesh;
}

/// The upper joint stands at the elbow and turns about Z by `angle`.
std::array<glm::mat4, 2> bent(float angle) {
    const glm::mat4 elbow = glm::translate(glm::mat4(1.0F), glm::vec3(0.0F, 1.0F, 0.0F));
    return {glm::mat4(1.0F),
            elbow * glm::rotate(glm::mat4(1.0F), angle, glm::vec3(0.0F, 0.0F, 1.0F)) * glm::inverse(elbow)};
}

TEST(Skin, PoseOfRestLeavesTheMesh) {
    const Mesh mesh = arm();
    const Mesh same = posed(mesh, bent(0.0F));
    EXPECT_EQ(same.positions, mesh.positions);
    EXPECT_EQ(same.normals, mesh.normals);
    EXPECT_EQ(same.tangents, mesh.tangents);
    EXPECT_EQ(same.uvs, mesh.uvs);
    EXPECT_EQ(same.indices, mesh.indices);
}

TEST(Skin, TwoJointsBlendPositions) {
    const Mesh result = posed(arm(), bent(kQuarterTurn));
    // By hand: the upper joint takes (x, 2) to (-1, 1 + x) and (x, 1) to (0, 1 + x); the elbow is half way.
    const std::array<glm::vec3, 6> expected = {
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5F, 1.5F, 0}, {-1, 1, 0}, {-1, 2, 0}}};
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_LT(glm::distance(result.positions[i], expected[i]), 1e-6F) << i;  // rounding of the sine
    // The tangent turns with the upper arm, and by half at the elbow.
    EXPECT_LT(glm::distance(glm::vec3(result.tangents[4]), glm::vec3(0.0F, 1.0F, 0.0F)), 1e-6F);
    EXPECT_LT(glm::distance(glm::vec3(result.tangents[2]), glm::normalize(glm::vec3(1.0F, 1.0F, 0.0F))), 1e-6F);
    EXPECT_TRUE(test::is_sane(result));
}

TEST(Skin, NormalsStayPerpendicularUnderUnevenScale) {
    Mesh mesh = build_mesh(SphereRecipe{.radius = 1.0, .rings = 16, .segments = 32});
    mesh.joints.assign(mesh.positions.size(), glm::u16vec4(0));
    mesh.weights.assign(mesh.positions.size(), glm::vec4(1.0F, 0.0F, 0.0F, 0.0F));
    // Mirrored as well: normals point outward still.
    const std::array<glm::mat4, 1> joints = {glm::scale(glm::mat4(1.0F), glm::vec3(-4.0F, 1.0F, 0.5F))};
    const Mesh result = posed(mesh, joints);
    EXPECT_TRUE(test::is_sane(result));
    for (std::size_t i = 0; i < result.positions.size(); ++i) {
        const glm::vec3 p = result.positions[i];
        const glm::vec3 expected = glm::normalize(glm::vec3(p.x / 16.0F, p.y, p.z / 0.25F));
        EXPECT_LT(glm::distance(result.normals[i], expected), 2e-6F) << i;  // rounding, stretched by the scale
    }
}

TEST(Skin, JointMatricesTakeTheBindPoseOut) {
    ecs::World world;
    const ecs::Entity shoulder = world.create();
    world.add(shoulder, Transform{.translation = {5.0F, 0.0F, 0.0F}});
    const ecs::Entity elbow = world.create();
    world.add(elbow, Transform{.translation = {0.0F, 1.0F, 0.0F}});
    world.add(elbow, Parent{shoulder});
    const ecs::Entity loose = world.create();
    update_world_matrices(world);
    const glm::mat4 down = glm::translate(glm::mat4(1.0F), glm::vec3(0.0F, -1.0F, 0.0F));
    const Skin skin{{shoulder, elbow, loose}, {glm::mat4(1.0F), down, down}};
    const std::vector<glm::mat4> matrices = joint_matrices(world, skin);
    ASSERT_EQ(matrices.size(), 3U);
    EXPECT_EQ(glm::vec3(matrices[0][3]), glm::vec3(5.0F, 0.0F, 0.0F));
    EXPECT_EQ(glm::vec3(matrices[1][3]), glm::vec3(5.0F, 0.0F, 0.0F));
    EXPECT_EQ(matrices[2], down) << "a joint without a WorldMatrix stands at the origin";
}

TEST(SkinDeathTest, JointBeyondTheSkinIsALogicError) {
    const std::array<glm::mat4, 1> one = {glm::mat4(1.0F)};
    EXPECT_DEATH(posed(arm(), one), "joints\\[i\\] < matrices.size");
}

}  // namespace
}  // namespace rowland::scene
