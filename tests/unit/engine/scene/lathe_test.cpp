#include "engine/scene/lathe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

using std::numbers::pi;

double area(const Mesh& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
        sum += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions[mesh.indices[i + 1]]) - a,
                                            glm::dvec3(mesh.positions[mesh.indices[i + 2]]) - a));
    }
    return sum;
}

/// The least cosine between a triangle's normal by its winding and its corners' normals.
double least_agreement(const Mesh& mesh) {
    double least = 1.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
        const glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(mesh.positions[mesh.indices[i + 1]]) - a,
                                                            glm::dvec3(mesh.positions[mesh.indices[i + 2]]) - a));
        for (std::size_t k = 0; k < 3; ++k)
            least = std::min(least, glm::dot(normal, glm::dvec3(mesh.normals[mesh.indices[i + k]])));
    }
    return least;
}

const std::vector<glm::dvec2> kCylinder = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 3.0}, {0.0, 3.0}};
/// A sphere's meridian.
std::vector<glm::dvec2> meridian(double radius, int points) {
    std::vector<glm::dvec2> profile;
    for (int i = 0; i < points; ++i) {
        const double polar = pi * i / (points - 1);
        profile.emplace_back(i == 0 || i + 1 == points ? 0.0 : radius * std::sin(polar), -radius * std::cos(polar));
    }
    return profile;
}

TEST(Lathe, StraightProfileMakesAClosedCylinder) {
    const Mesh mesh = build_lathe({.profile = kCylinder, .segments = 200});
    EXPECT_TRUE(test::is_sane(mesh));
    // Two caps of 200 and 201 vertices, a wall of two rows.
    EXPECT_EQ(mesh.positions.size(), 4U * 201U + 2U * 200U);
    EXPECT_EQ(mesh.indices.size(), 3U * (2U * 200U + 2U * 200U));
    // A regular 200-gon has sin(2π/200)/(2π/200) of the circle's area and sin(π/200)/(π/200) of its circumference;
    // positions are floats.
    const double polygon = std::sin(pi / 100.0) / (pi / 100.0);
    const double around = std::sin(pi / 200.0) / (pi / 200.0);
    EXPECT_NEAR(test::signed_volume(mesh) / (12.0 * pi * polygon), 1.0, 1e-6);
    EXPECT_NEAR(area(mesh) / (8.0 * pi * polygon + 12.0 * pi * around), 1.0, 1e-6);
    // A wall's facet turns by half a sector from its corners' normals.
    EXPECT_NEAR(least_agreement(mesh), std::cos(pi / 200.0), 1e-6);
}

TEST(Lathe, SmoothMeridianIsASphere) {
    const Mesh mesh = build_lathe({.profile = meridian(0.5, 17), .smooth = true, .steps = 8, .segments = 256});
    EXPECT_TRUE(test::is_sane(mesh));
    double furthest = 0.0;
    double most_tilted = 1.0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 p(mesh.positions[i]);
        furthest = std::max(furthest, std::abs(glm::length(p) - 0.5));
        most_tilted = std::min(most_tilted, glm::dot(glm::normalize(p), glm::dvec3(mesh.normals[i])));
    }
    // The curve is exact at the points; between them, π/16 apart, it misses the circle by 1.74e-5 and tilts its normals
    // by 5.3e-4 rad, which takes 1.4e-7 of the cosine (computed in double precision). Floats add 2e-7.
    EXPECT_LT(furthest, 1.8e-5);
    EXPECT_GT(most_tilted, 1.0 - 4e-7);
    EXPECT_NEAR(test::signed_volume(mesh) / (pi / 6.0), 1.0, 2e-3);
}

TEST(Lathe, FlattenedSphereIsAnEllipsoidWithItsNormals) {
    const Mesh mesh =
        build_lathe({.profile = meridian(1.0, 33), .smooth = true, .steps = 4, .segments = 128, .flatten = 0.5});
    EXPECT_TRUE(test::is_sane(mesh));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 p(mesh.positions[i]);
        const glm::dvec3 gradient = glm::normalize(glm::dvec3(p.x, p.y, p.z / 0.25));
        // Points half as far apart tilt by 1e-4 rad, less than what floats show in a cosine.
        EXPECT_GT(glm::dot(gradient, glm::dvec3(mesh.normals[i])), 1.0 - 4e-7);
    }
    EXPECT_NEAR(test::signed_volume(mesh) / (4.0 / 3.0 * pi * 0.5), 1.0, 3e-3);
}

TEST(Lathe, TangentsRunAroundOrAlongAndStayInTheSurface) {
    const LatheRecipe around{.profile = {{1.0, 0.0}, {2.0, 1.0}}, .segments = 16};
    LatheRecipe along = around;
    along.tangent = LatheRecipe::Tangent::Along;
    const Mesh parallels = build_lathe(around);
    const Mesh meridians = build_lathe(along);
    EXPECT_TRUE(test::is_sane(parallels));
    EXPECT_TRUE(test::is_sane(meridians));
    for (std::size_t i = 0; i < parallels.positions.size(); ++i) {
        EXPECT_EQ(parallels.tangents[i].y, 0.0F);
        EXPECT_NEAR(meridians.tangents[i].y, std::sqrt(0.5), 1e-6);
        // v grows along cross(normal, tangent): towards the next row for the one, back around for the other.
        const glm::vec3 up = glm::cross(parallels.normals[i], glm::vec3(parallels.tangents[i]));
        EXPECT_GT(glm::dot(up, glm::vec3(meridians.tangents[i])), 0.999F);
        EXPECT_FLOAT_EQ(meridians.uvs[i].x, parallels.uvs[i].y);
        EXPECT_FLOAT_EQ(meridians.uvs[i].y, 1.0F - parallels.uvs[i].x);
    }
}

TEST(Lathe, PartOfATurnBeginsAndEndsWhereItSays) {
    const Mesh mesh =
        build_lathe({.profile = {{1.0, 0.0}, {1.0, 1.0}}, .segments = 10, .from_deg = 90.0, .to_deg = 180.0});
    EXPECT_EQ(mesh.positions.size(), 22U);
    const auto near = [](const glm::vec3& a, const glm::vec3& b) { return glm::distance(a, b) < 1e-6F; };
    EXPECT_TRUE(near(mesh.positions[0], {0.0F, 0.0F, -1.0F}));
    EXPECT_TRUE(near(mesh.positions[10], {-1.0F, 0.0F, 0.0F}));
    EXPECT_EQ(mesh.uvs[10].x, 1.0F);
}

TEST(Lathe, WholeTurnMeetsItselfExactly) {
    const Mesh mesh = build_lathe({.profile = {{1.0, 0.0}, {1.0, 1.0}}, .segments = 7});
    EXPECT_EQ(mesh.positions[0], mesh.positions[7]);
    EXPECT_EQ(mesh.normals[0], mesh.normals[7]);
}

TEST(Lathe, RingIsClosedWithItsOutsideOut) {
    const Mesh ring =
        build_lathe({.profile = {{1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}, {1.0, 0.0}}, .segments = 100});
    EXPECT_TRUE(test::is_sane(ring));
    const double polygon = std::sin(pi / 50.0) / (pi / 50.0);
    EXPECT_NEAR(test::signed_volume(ring) / (3.0 * pi * polygon), 1.0, 1e-6);
}

}  // namespace
}  // namespace rowland::scene
