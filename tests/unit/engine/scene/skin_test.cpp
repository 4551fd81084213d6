#include "engine/scene/skin.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/scene/mesh_recipe.h"
#include "engine/scene/transform.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

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
