#include "modules/diffraction/runtime/flatness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace rowland::diffraction {
namespace {

scene::Mesh mesh_of(std::vector<glm::vec3> normals) {
    scene::Mesh mesh;
    mesh.normals = std::move(normals);
    return mesh;
}

TEST(Flatness, OneNormalIsFlat) {
    const glm::vec3 n = glm::normalize(glm::vec3(0.2F, -0.3F, 0.9F));
    const auto found = flat_normal(mesh_of({n, n, n, n}));
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(glm::length(*found - glm::dvec3(n)), 1e-6);  // float
}

TEST(Flatness, RoundingIsFlatAndACurveIsNot) {
    const auto leaning = [](float angle) { return glm::vec3(std::sin(angle), 0.0F, std::cos(angle)); };
    EXPECT_TRUE(flat_normal(mesh_of({leaning(0.0F), leaning(0.004F)})).has_value());
    EXPECT_FALSE(flat_normal(mesh_of({leaning(0.0F), leaning(0.0F), leaning(0.02F)})).has_value());
}

TEST(Flatness, TwoSidesAreNotFlat) {
    const glm::vec3 n(0.0F, 0.0F, 1.0F);
    EXPECT_FALSE(flat_normal(mesh_of({n, n, n, n, -n})).has_value());
    EXPECT_FALSE(flat_normal(mesh_of({n, -n})).has_value());
    EXPECT_FALSE(flat_normal(mesh_of({})).has_value());
}

TEST(CommonTangent, IsOfAllVerticesOrNone) {
    scene::Mesh mesh;
    const glm::vec4 x(1.0F, 0.0F, 0.0F, 1.0F);
    EXPECT_FALSE(common_tangent(mesh).has_value());
    mesh.tangents = {x, {std::cos(0.004F), std::sin(0.004F), 0.0F, 1.0F}};
    EXPECT_EQ(common_tangent(mesh), x);
    mesh.tangents = {x, {std::cos(0.02F), std::sin(0.02F), 0.0F, 1.0F}};
    EXPECT_FALSE(common_tangent(mesh).has_value());
    mesh.tangents = {x, {1.0F, 0.0F, 0.0F, -1.0F}};
    EXPECT_FALSE(common_tangent(mesh).has_value());
}

}  // namespace
}  // namespace rowland::diffraction
