#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/core/error.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/mesh_recipe.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

ImportedScene sphere_with(const glm::mat4& transform) {
    ImportedScene scene;
    scene.meshes.push_back(build_mesh(SphereRecipe{.radius = 1.0, .rings = 32, .segments = 64}));
    scene.instances.push_back({"sphere", transform, 0, std::nullopt, 0, std::nullopt});
    return scene;
}

/// The direction in which v grows, as mesh.h defines the tangent's sign.
glm::vec3 bitangent(const Mesh& mesh, std::size_t i) {
    return glm::cross(mesh.normals[i], glm::vec3(mesh.tangents[i])) * mesh.tangents[i].w;
}

TEST(MergeInstances, MirroredSphereStillFacesOutward) {
    const glm::mat4 mirror = glm::scale(glm::mat4(1.0F), glm::vec3(-1.0F, 1.0F, 1.0F));
    const Mesh merged = merge_instances(sphere_with(mirror));
    EXPECT_TRUE(test::is_sane(merged));
    EXPECT_GT(test::signed_volume(merged), 4.0);
    for (std::size_t i = 0; i < merged.positions.size(); ++i)
        EXPECT_GT(glm::dot(merged.normals[i], merged.positions[i]), 0.999F);
}

TEST(MergeInstances, MirroredBitangentIsTheMirrorImage) {
    const ImportedScene scene = sphere_with(glm::scale(glm::mat4(1.0F), glm::vec3(1.0F, 1.0F, -1.0F)));
    const Mesh merged = merge_instances(scene);
    for (std::size_t i = 0; i < merged.positions.size(); ++i) {
        const glm::vec3 expected = bitangent(scene.meshes[0], i) * glm::vec3(1.0F, 1.0F, -1.0F);
        EXPECT_LT(glm::distance(bitangent(merged, i), expected), 1e-6F) << i;  // rounding
    }
}

TEST(MergeInstances, NormalsStayPerpendicularUnderUnevenScale) {
    // An ellipsoid x²/16 + y² + z²/0.25 = 1 has the normal (x/16, y, z/0.25).
    const Mesh merged = merge_instances(sphere_with(glm::scale(glm::mat4(1.0F), glm::vec3(4.0F, 1.0F, 0.5F))));
    EXPECT_TRUE(test::is_sane(merged));
    for (std::size_t i = 0; i < merged.positions.size(); ++i) {
        const glm::vec3 p = merged.positions[i];
        const glm::vec3 expected = glm::normalize(glm::vec3(p.x / 16.0F, p.y, p.z / 0.25F));
        EXPECT_LT(glm::distance(merged.normals[i], expected), 2e-6F) << i;  // rounding, stretched by the scale
    }
}

TEST(MergeInstances, TwoInstancesStandApart) {
    ImportedScene scene = sphere_with(glm::mat4(1.0F));
    scene.instances.push_back(
        {"moved", glm::translate(glm::mat4(1.0F), glm::vec3(10.0F, 0.0F, 0.0F)), 0, std::nullopt, 0, std::nullopt});
    const Mesh merged = merge_instances(scene);
    EXPECT_EQ(merged.positions.size(), 2 * scene.meshes[0].positions.size());
    EXPECT_FLOAT_EQ(bounds(merged).minimum.x, -1.0F);
    EXPECT_FLOAT_EQ(bounds(merged).maximum.x, 11.0F);
    EXPECT_NEAR(test::signed_volume(merged), 2.0 * test::signed_volume(scene.meshes[0]), 1e-4);  // float rounding at 10
}

TEST(MergeInstances, FlattenedInstanceStaysSane) {
    EXPECT_TRUE(test::is_sane(merge_instances(sphere_with(glm::scale(glm::mat4(1.0F), glm::vec3(1.0F, 0.0F, 1.0F))))));
    EXPECT_TRUE(test::is_sane(merge_instances(sphere_with(glm::scale(glm::mat4(1.0F), glm::vec3(0.0F))))));
}

TEST(MergeInstances, OverflowingInstanceIsRefused) {
    ImportedScene scene = sphere_with(glm::scale(glm::mat4(1.0F), glm::vec3(3e38F)));
    for (glm::vec3& position : scene.meshes[0].positions) position *= 10.0F;
    EXPECT_THROW(merge_instances(scene), Error);
}

TEST(MergeInstances, ManyCopiesOfALargeMeshAreRefusedBeforeTheyAreMade) {
    ImportedScene scene = sphere_with(glm::mat4(1.0F));
    scene.instances.resize(100'000, scene.instances[0]);
    EXPECT_THROW(merge_instances(scene), Error);
}

TEST(MergeInstances, EmptySceneIsAnEmptyMesh) {
    const Mesh merged = merge_instances({});
    EXPECT_TRUE(merged.positions.empty());
    EXPECT_EQ(bounds(merged).maximum, glm::vec3(0.0F));
}

}  // namespace
}  // namespace rowland::scene
