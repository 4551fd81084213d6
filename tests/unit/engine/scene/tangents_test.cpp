#include "engine/scene/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/scene/mesh_recipe.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

Mesh triangle() {
    Mesh mesh;
    mesh.positions = {{0.0F, 0.0F, 0.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    mesh.uvs = {{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}};
    mesh.indices = {0, 1, 2};
    return mesh;
}

TEST(Tangents, NormalOfTriangleFollowsItsWinding) {
    Mesh mesh = triangle();
    generate_normals(mesh);
    for (const glm::vec3& n : mesh.normals) EXPECT_EQ(n, glm::vec3(0.0F, 0.0F, 1.0F));
    std::swap(mesh.indices[1], mesh.indices[2]);
    generate_normals(mesh);
    for (const glm::vec3& n : mesh.normals) EXPECT_EQ(n, glm::vec3(0.0F, 0.0F, -1.0F));
}

TEST(Tangents, NormalsAreWeightedByArea) {
    // Two triangles share vertex 0: area 1/2 facing +Z and area 2 facing +X.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 0, 2}};
    mesh.indices = {0, 1, 2, 0, 3, 4};
    generate_normals(mesh);
    const glm::vec3 expected = glm::normalize(glm::vec3(2.0F, 0.0F, 0.5F));
    // Rounding of one normalisation.
    EXPECT_NEAR(mesh.normals[0].x, expected.x, 1e-6F);
    EXPECT_NEAR(mesh.normals[0].z, expected.z, 1e-6F);
}

TEST(Tangents, VertexWithoutAreaGetsUsableNormal) {
    Mesh mesh;
    mesh.positions = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    mesh.indices = {0, 1, 2};
    generate_normals(mesh);
    for (const glm::vec3& n : mesh.normals) EXPECT_EQ(n, glm::vec3(0.0F, 1.0F, 0.0F));
}

TEST(Tangents, TangentFollowsGrowingU) {
    Mesh mesh = triangle();
    generate_normals(mesh);
    generate_tangents(mesh);
    for (const glm::vec4& t : mesh.tangents) EXPECT_EQ(t, glm::vec4(1.0F, 0.0F, 0.0F, -1.0F));
    for (glm::vec2& uv : mesh.uvs) uv.x = -uv.x;
    generate_tangents(mesh);
    for (const glm::vec4& t : mesh.tangents) EXPECT_EQ(t, glm::vec4(-1.0F, 0.0F, 0.0F, 1.0F));
    for (glm::vec2& uv : mesh.uvs) uv = {uv.y, -uv.x};
    generate_tangents(mesh);
    for (const glm::vec4& t : mesh.tangents) EXPECT_EQ(t, glm::vec4(0.0F, 1.0F, 0.0F, 1.0F));
}

TEST(Tangents, DegenerateUvsGivePerpendicularTangents) {
    Mesh mesh = build_mesh(SphereRecipe{.radius = 1.0, .rings = 8, .segments = 12});
    for (glm::vec2& uv : mesh.uvs) uv = glm::vec2(0.5F);
    generate_tangents(mesh);
    EXPECT_TRUE(test::is_sane(mesh));
    for (glm::vec2& uv : mesh.uvs) uv = glm::vec2(std::numeric_limits<float>::max());
    generate_tangents(mesh);
    for (glm::vec2& uv : mesh.uvs) uv = glm::vec2(0.0F);
    EXPECT_TRUE(test::is_sane(mesh));
}

TEST(Tangents, GeneratedOnesAgreeWithTheSpheresOwn) {
    Mesh mesh = build_mesh(SphereRecipe{.radius = 2.0, .rings = 64, .segments = 128});
    const std::vector<glm::vec4> exact = mesh.tangents;
    generate_tangents(mesh);
    EXPECT_TRUE(test::is_sane(mesh));
    for (std::size_t i = 0; i < exact.size(); ++i) {
        // Chords and tangents of a 128th of the circle differ by up to half of that angle.
        EXPECT_GT(glm::dot(glm::vec3(exact[i]), glm::vec3(mesh.tangents[i])), std::cos(3.1416F / 128.0F)) << i;
        EXPECT_EQ(mesh.tangents[i].w, exact[i].w) << i;
    }
}

TEST(Tangents, PerpendicularExistsForEveryDirection) {
    const Mesh directions = build_mesh(SphereRecipe{.radius = 1.0, .rings = 32, .segments = 32});
    for (const glm::vec3& n : directions.normals) {
        const glm::vec3 p = any_perpendicular(n);
        EXPECT_NEAR(glm::length(p), 1.0F, 1e-6F);  // rounding
        EXPECT_NEAR(glm::dot(p, n), 0.0F, 1e-6F);
    }
}

TEST(Tangents, UnusableTangentIsReplacedAndReported) {
    const glm::vec3 n(0.0F, 1.0F, 0.0F);
    glm::vec4 slanted(1.0F, 1.0F, 0.0F, -0.5F);
    EXPECT_TRUE(orthonormalise_tangent(slanted, n));
    EXPECT_EQ(slanted, glm::vec4(1.0F, 0.0F, 0.0F, -1.0F));
    glm::vec4 along(0.0F, 3.0F, 0.0F, 1.0F);
    EXPECT_FALSE(orthonormalise_tangent(along, n));
    EXPECT_EQ(glm::dot(glm::vec3(along), n), 0.0F);
    glm::vec4 zero(0.0F);
    EXPECT_FALSE(orthonormalise_tangent(zero, n));
    EXPECT_EQ(glm::length(glm::vec3(zero)), 1.0F);
}

}  // namespace
}  // namespace rowland::scene
