#include "engine/scene/box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

using std::numbers::pi;

struct Faces {
    double area = 0.0;
    double least_agreement = 1.0;  ///< cosine between a triangle's normal by its winding and those of its corners
};

Faces measure(const Mesh& mesh) {
    Faces faces;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
        const glm::dvec3 cross = glm::cross(glm::dvec3(mesh.positions[mesh.indices[i + 1]]) - a,
                                            glm::dvec3(mesh.positions[mesh.indices[i + 2]]) - a);
        faces.area += 0.5 * glm::length(cross);
        for (std::size_t k = 0; k < 3; ++k)
            faces.least_agreement = std::min(
                faces.least_agreement, glm::dot(glm::normalize(cross), glm::dvec3(mesh.normals[mesh.indices[i + k]])));
    }
    return faces;
}

TEST(Box, SharpBoxHasItsVolumeAreaAndFlatNormals) {
    const Mesh mesh = build_box({.width = 2.0, .height = 3.0, .depth = 5.0});
    EXPECT_TRUE(test::is_sane(mesh));
    EXPECT_NEAR(test::signed_volume(mesh), 30.0, 1e-5);
    const Faces faces = measure(mesh);
    EXPECT_NEAR(faces.area, 2.0 * (6.0 + 10.0 + 15.0), 1e-5);
    EXPECT_NEAR(faces.least_agreement, 1.0, 1e-6);
    const Bounds box = bounds(mesh);
    EXPECT_EQ(box.minimum, glm::vec3(-1.0F, 0.0F, -2.5F));
    EXPECT_EQ(box.maximum, glm::vec3(1.0F, 3.0F, 2.5F));
}

TEST(Box, RoundCornersTakeTheirShareOfTheArea) {
    const Mesh mesh =
        build_box({.width = 0.0856, .height = 0.00076, .depth = 0.054, .corner_radius = 0.00318, .corner_steps = 16});
    EXPECT_TRUE(test::is_sane(mesh));
    // Four inscribed arcs of 16 facets: 32 sin(π/32) r² in place of π r².
    const double corners = 32.0 * std::sin(pi / 32.0) * 0.00318 * 0.00318;
    const double outline = 0.0856 * 0.054 - 4.0 * 0.00318 * 0.00318 + corners;
    EXPECT_NEAR(test::signed_volume(mesh) / (outline * 0.00076), 1.0, 1e-5);
    // A facet of a corner turns by half of 90°/16 from its corners' normals.
    EXPECT_NEAR(measure(mesh).least_agreement, std::cos(pi / 64.0), 1e-5);
}

TEST(Box, BevelsCutTheEdgesAt45Degrees) {
    const double b = 0.25;
    const Mesh mesh = build_box({.width = 4.0, .height = 2.0, .depth = 3.0, .bevel = b});
    EXPECT_TRUE(test::is_sane(mesh));
    // At either end a frustum whose sections shrink by 2b in b of height, by the prismoidal rule.
    const auto section = [](double inset) { return (4.0 - 2.0 * inset) * (3.0 - 2.0 * inset); };
    const double frustum = b / 6.0 * (section(0.0) + 4.0 * section(b / 2.0) + section(b));
    EXPECT_NEAR(test::signed_volume(mesh), 12.0 * (2.0 - 2.0 * b) + 2.0 * frustum, 1e-5);
    EXPECT_NEAR(measure(mesh).least_agreement, 1.0, 1e-6);
}

TEST(Box, OnlyTheWantedFacesAreThere) {
    BoxRecipe recipe{.width = 2.0, .height = 1.0, .depth = 1.0, .corner_radius = 0.25, .bevel = 0.1};
    const double whole = measure(build_box(recipe)).area;
    recipe.sides = recipe.bottom = false;
    const Mesh top = build_box(recipe);
    for (const glm::vec3& normal : top.normals) EXPECT_EQ(normal, glm::vec3(0.0F, 1.0F, 0.0F));
    for (const glm::vec4& tangent : top.tangents) EXPECT_EQ(tangent, glm::vec4(1.0F, 0.0F, 0.0F, -1.0F));
    recipe.top = false;
    recipe.bottom = true;
    const Mesh bottom = build_box(recipe);
    for (const glm::vec3& normal : bottom.normals) EXPECT_EQ(normal, glm::vec3(0.0F, -1.0F, 0.0F));
    recipe.bottom = false;
    recipe.sides = true;
    const double parts = measure(top).area + measure(bottom).area + measure(build_box(recipe)).area;
    EXPECT_NEAR(parts / whole, 1.0, 1e-6);
}

TEST(Box, TopIsMappedAsAPlane) {
    const Mesh top =
        build_box({.width = 2.0, .height = 1.0, .depth = 4.0, .corner_radius = 0.5, .sides = false, .bottom = false});
    for (std::size_t i = 0; i < top.positions.size(); ++i) {
        EXPECT_NEAR(top.uvs[i].x, 0.5F + top.positions[i].x / 2.0F, 1e-6F);
        EXPECT_NEAR(top.uvs[i].y, 0.5F - top.positions[i].z / 4.0F, 1e-6F);
    }
}

TEST(Box, DiscIsTheRoundestBox) {
    const Mesh mesh = build_box({.width = 2.0, .height = 1.0, .depth = 2.0, .corner_radius = 1.0, .corner_steps = 25});
    EXPECT_TRUE(test::is_sane(mesh));
    EXPECT_NEAR(test::signed_volume(mesh) / pi, std::sin(pi / 50.0) / (pi / 50.0), 1e-5);
}

}  // namespace
}  // namespace rowland::scene
