// Mesh recipes, tangents, and rays through meshes.
#include "engine/scene/mesh.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/scene/mesh_recipe.h"
#include "engine/scene/ray.h"
#include "tests/support/expect.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

MeshRecipe parse(const std::string& text) {
    return parse_mesh_recipe(parse_json(text, "r.json"), "r.json");
}

std::string recipe_error(const std::string& text) {
    return rowland::test::message_of([&] { parse(text); });
}

Mesh recipe_disc() {
    return build_mesh(DiscRecipe{.inner_radius = 0.0235, .outer_radius = 0.06});
}

/// The normal of triangle `i` by its winding, not unit.
glm::dvec3 face_normal(const Mesh& mesh, std::size_t i) {
    const glm::dvec3 a(mesh.positions[mesh.indices[3 * i]]);
    return glm::cross(glm::dvec3(mesh.positions[mesh.indices[3 * i + 1]]) - a,
                      glm::dvec3(mesh.positions[mesh.indices[3 * i + 2]]) - a);
}

TEST(MeshRecipe, DiscHas25000VerticesByDefault) {
    const Mesh disc = recipe_disc();
    EXPECT_EQ(disc.positions.size(), 25000U);
    EXPECT_EQ(disc.indices.size(), 3U * 2U * 99U * 249U);
    EXPECT_TRUE(test::is_sane(disc));
}

TEST(MeshRecipe, DiscIsFlatWithRadialTangentsAndGroovesAlongTheAngle) {
    const Mesh disc = recipe_disc();
    for (std::size_t i = 0; i < disc.positions.size(); ++i) {
        EXPECT_EQ(disc.positions[i].y, 0.0F);
        const double radius = glm::length(glm::dvec3(disc.positions[i]));
        // Rounding to float of two coordinates.
        EXPECT_GE(radius, 0.0235 * (1.0 - 1e-7));
        EXPECT_LE(radius, 0.06 * (1.0 + 1e-7));
        // Positions and tangents are rounded to float: 2^-24 of each, in two coordinates.
        const glm::vec3 g(disc.tangents[i]);
        EXPECT_LT(glm::length(glm::dvec3(g) - glm::dvec3(disc.positions[i]) / radius), 2.5e-7) << i;
        EXPECT_EQ(disc.tangents[i].w, -1.0F);
        EXPECT_EQ(disc.normals[i], glm::vec3(0.0F, 1.0F, 0.0F));
        // From +X towards −Z; v is a float, so the angle is good to 2π · 2^-24.
        const glm::vec3 h = glm::cross(disc.normals[i], g);
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(disc.uvs[i].y);
        EXPECT_NEAR(h.x, -std::sin(angle), 1e-6);
        EXPECT_NEAR(h.z, -std::cos(angle), 1e-6);
    }
}

TEST(MeshRecipe, DiscSeamMeetsExactly) {
    const Mesh disc = recipe_disc();
    for (std::size_t ring = 0; ring < 100; ++ring) {
        EXPECT_EQ(disc.positions[ring * 250], disc.positions[ring * 250 + 249]);
        EXPECT_EQ(disc.uvs[ring * 250].y, 0.0F);
        EXPECT_EQ(disc.uvs[ring * 250 + 249].y, 1.0F);
    }
}

TEST(MeshRecipe, DiscIsCounterClockwiseFromAboveAndHasTheAnnulusArea) {
    const Mesh disc = recipe_disc();
    double area = 0.0;
    for (std::size_t i = 0; i < disc.indices.size() / 3; ++i) {
        EXPECT_GT(face_normal(disc, i).y, 0.0) << i;
        area += face_normal(disc, i).y / 2.0;
    }
    // A regular 249-gon has sin(2π/249)/(2π/249) of the circle's area; floats add about 1e-7.
    const double step = 2.0 * std::numbers::pi / 249.0;
    const double expected = std::numbers::pi * (0.06 * 0.06 - 0.0235 * 0.0235) * std::sin(step) / step;
    EXPECT_NEAR(area / expected, 1.0, 1e-6);
}

TEST(MeshRecipe, SphereFacesOutwardWithTangentsAlongLongitude) {
    const Mesh sphere = build_mesh(SphereRecipe{.radius = 0.5, .rings = 64, .segments = 128});
    EXPECT_TRUE(test::is_sane(sphere));
    for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
        const glm::vec3 p = sphere.positions[i];
        EXPECT_NEAR(glm::length(p), 0.5F, 1e-6F);  // rounding
        const double longitude = 2.0 * std::numbers::pi * static_cast<double>(sphere.uvs[i].x);
        EXPECT_NEAR(sphere.tangents[i].x, -std::sin(longitude), 1e-6);
        EXPECT_NEAR(sphere.tangents[i].y, 0.0, 1e-6);
        EXPECT_NEAR(sphere.tangents[i].z, -std::cos(longitude), 1e-6);
    }
    for (std::size_t i = 0; i < sphere.indices.size() / 3; ++i)
        EXPECT_GT(glm::dot(face_normal(sphere, i), glm::dvec3(sphere.positions[sphere.indices[3 * i]])), 0.0) << i;
    // The inscribed polyhedron lacks O(step²) of the volume: 2/5 · (2π/128)² ≈ 1e-3 and less.
    EXPECT_NEAR(test::signed_volume(sphere) / (4.0 / 3.0 * std::numbers::pi * 0.125), 1.0, 2e-3);
}

TEST(MeshRecipe, PlaneLiesInXzFacingUpWithTangentX) {
    const Mesh plane = build_mesh(PlaneRecipe{.width = 3.0, .depth = 2.0, .subdivisions = 4});
    EXPECT_TRUE(test::is_sane(plane));
    EXPECT_EQ(plane.positions.size(), 25U);
    EXPECT_EQ(bounds(plane).minimum, glm::vec3(-1.5F, 0.0F, -1.0F));
    EXPECT_EQ(bounds(plane).maximum, glm::vec3(1.5F, 0.0F, 1.0F));
    for (std::size_t i = 0; i < plane.indices.size() / 3; ++i) EXPECT_GT(face_normal(plane, i).y, 0.0);
    for (const glm::vec4& tangent : plane.tangents) EXPECT_EQ(tangent, glm::vec4(1.0F, 0.0F, 0.0F, -1.0F));
}

TEST(MeshRecipe, ReadsEveryType) {
    const auto disc = std::get<DiscRecipe>(
        parse(R"({"mesh": {"type": "disc", "inner_radius": 0, "outer_radius": 1, "rings": 2, "segments": 5}})"));
    EXPECT_EQ(disc.outer_radius, 1.0);
    EXPECT_EQ(disc.rings, 2);
    EXPECT_EQ(disc.segments, 5);
    const auto sphere = std::get<SphereRecipe>(parse(R"({"mesh": {"type": "sphere", "radius": 0.5}})"));
    EXPECT_EQ(sphere.radius, 0.5);
    const auto plane =
        std::get<PlaneRecipe>(parse(R"({"mesh": {"type": "plane", "size": [2, 3], "subdivisions": 7}})"));
    EXPECT_EQ(plane.depth, 3.0);
    EXPECT_EQ(plane.subdivisions, 7);
}

TEST(MeshRecipe, RefusalsNamePlaceAndWhatWasMeant) {
    using testing::HasSubstr;
    EXPECT_THAT(recipe_error(R"({"mesh": {"type": "disk", "inner_radius": 0, "outer_radius": 1}})"),
                testing::AllOf(HasSubstr("r.json: /mesh/type"), HasSubstr("\"disc\"")));
    EXPECT_THAT(recipe_error(R"({"mesh": {"type": "disc", "iner_radius": 0, "outer_radius": 1}})"),
                HasSubstr("inner_radius"));
    EXPECT_THAT(recipe_error(R"({"mesh": {"type": "sphere", "radius": 1, "segmants": 9}})"), HasSubstr("segments"));
    EXPECT_THAT(recipe_error(R"({"mesh": {"type": "sphere", "radius": -1}})"), HasSubstr("/mesh/radius"));
    EXPECT_THAT(recipe_error(R"({"mesh": {"type": "plane", "size": [1, 1], "subdivisions": 1000000}})"),
                HasSubstr("/mesh/subdivisions"));
    EXPECT_THAT(recipe_error(R"({"mesh": {"type": "disc", "inner_radius": 2, "outer_radius": 1}})"),
                HasSubstr("more than inner_radius, 2"));
    EXPECT_THAT(recipe_error(R"({"mesh": 3})"), HasSubstr("an object"));
}

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

TEST(Ray, MeetsTheBoxOfEveryMeshThatItHits) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> number(-2.0F, 2.0F);
    const Mesh sphere = build_mesh(SphereRecipe{.radius = 1.0, .rings = 8, .segments = 12});
    const Mesh flat = build_mesh(PlaneRecipe{.width = 2.0, .depth = 1.0, .subdivisions = 1});
    int hits = 0;
    int misses = 0;
    for (int i = 0; i < 2000; ++i) {
        const Ray ray{glm::vec3(number(random), number(random), number(random)),
                      glm::vec3(number(random), number(random), number(random))};
        for (const Mesh* mesh : {&sphere, &flat}) {
            if (nearest_hit(ray, *mesh)) {
                ++hits;
                EXPECT_TRUE(meets(ray, bounds(*mesh)));
            } else {
                misses += meets(ray, bounds(*mesh)) ? 0 : 1;
            }
        }
    }
    EXPECT_GT(hits, 200);
    EXPECT_GT(misses, 1000);
}

}  // namespace
}  // namespace rowland::scene
