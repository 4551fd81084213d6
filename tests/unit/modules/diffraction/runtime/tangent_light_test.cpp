#include "modules/diffraction/runtime/tangent_light.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "engine/math/sh_basis.h"

namespace rowland::diffraction {
namespace {

scene::Mesh two_vertices() {
    scene::Mesh mesh;
    mesh.positions = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}};
    mesh.normals = {{0.0F, 1.0F, 0.0F}, glm::normalize(glm::vec3(1.0F, 2.0F, -1.0F))};
    mesh.tangents = {{1.0F, 0.0F, 0.0F, 1.0F}, glm::vec4(glm::normalize(glm::vec3(2.0F, -1.0F, 0.0F)), 1.0F)};
    return mesh;
}

/// Turned, scaled, stretched, mirrored and very small objects.
std::vector<glm::mat4> objects() {
    const glm::mat4 turned = glm::rotate(glm::mat4(1.0F), 1.1F, glm::normalize(glm::vec3(0.2F, -1.0F, 0.6F)));
    return {turned, glm::scale(turned, glm::vec3(0.06F)), glm::scale(turned, glm::vec3(1.0F, 3.0F, 0.5F)),
            glm::scale(turned, glm::vec3(-1.0F, 1.0F, 1.0F)), glm::scale(turned, glm::vec3(-1e-9F, 2e-9F, 1e-9F))};
}

/// Radiance of SH light from a direction, channel by channel, the obvious way.
template <typename Coefficient>
glm::dvec3 radiance(int bands, const glm::dvec3& direction, const Coefficient& coefficient) {
    std::vector<double> basis(static_cast<std::size_t>(math::sh_count(bands)));
    math::evaluate_sh(direction, bands, basis);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < basis.size(); ++i) sum += basis[i] * coefficient(i);
    return sum;
}

TEST(TangentFrame, IsRightHandedAndFollowsAStretchedObject) {
    const glm::mat4 matrix =
        glm::scale(glm::rotate(glm::mat4(1.0F), 0.7F, glm::vec3(1.0F, 1.0F, 0.0F)), glm::vec3(1.0F, 3.0F, 0.5F));
    const scene::Mesh mesh = two_vertices();
    const glm::dmat3 rows = glm::transpose(tangent_frame(mesh.normals[1], glm::vec3(mesh.tangents[1]), matrix));
    const glm::dvec3 g = rows[0];
    const glm::dvec3 h = rows[1];
    const glm::dvec3 n = rows[2];
    EXPECT_NEAR(glm::length(h - glm::cross(n, g)), 0.0, 1e-12);
    EXPECT_NEAR(glm::dot(g, n), 0.0, 1e-12);
    // A vector in the surface stays in it; float input bounds it.
    const glm::dvec3 in_surface = glm::dmat3(matrix) * glm::dvec3(mesh.tangents[1]);
    EXPECT_NEAR(glm::dot(glm::normalize(in_surface), n), 0.0, 1e-6);
    EXPECT_GT(glm::dot(in_surface, g), 0.0);
}

/// A quarter turn leads to the bitangent that the mesh's object has, wherever the object's matrix takes it.
TEST(TangentFrame, GroovesTurnTowardTheBitangent) {
    const double quarter = 1.57079632679490;
    const glm::vec3 normal(0.0F, 1.0F, 0.0F);
    const glm::vec3 along(1.0F, 0.0F, 0.0F);
    for (const glm::mat4& matrix : objects())
        for (const float sign : {1.0F, -1.0F}) {
            const glm::vec3 bitangent = sign * glm::cross(normal, along);
            const glm::dvec3 g = glm::transpose(tangent_frame(normal, glm::vec4(along, sign), matrix, quarter))[0];
            EXPECT_GT(glm::dot(g, glm::normalize(glm::dmat3(matrix) * glm::dvec3(bitangent))), 1.0 - 1e-6);  // float
        }
}

TEST(TangentLight, EachVertexSeesTheSameLightInItsOwnFrame) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    lighting::ShLight light{.bands = 5, .coefficients = {}};
    for (int i = 0; i < 25; ++i) light.coefficients.emplace_back(uniform(random), uniform(random), uniform(random));
    const scene::Mesh mesh = two_vertices();
    for (const glm::mat4& matrix : objects()) {
        const std::vector<float> rotated = rotate_to_vertices(light, mesh, matrix);
        ASSERT_EQ(rotated.size(), 2U * 25U * 3U);
        for (std::size_t vertex = 0; vertex < 2; ++vertex) {
            const glm::dmat3 frame = tangent_frame(mesh.normals[vertex], glm::vec3(mesh.tangents[vertex]), matrix);
            for (int trial = 0; trial < 20; ++trial) {
                const glm::dvec3 s = glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)));
                const glm::dvec3 world = radiance(5, s, [&](std::size_t i) { return light.coefficients[i]; });
                const glm::dvec3 tangent = radiance(5, frame * s, [&](std::size_t i) {
                    const float* rgb = &rotated[(vertex * 25 + i) * 3];
                    return glm::dvec3(rgb[0], rgb[1], rgb[2]);
                });
                EXPECT_NEAR(glm::length(world - tangent), 0.0, 1e-5);  // stored as float
            }
        }
    }
}

}  // namespace
}  // namespace rowland::diffraction
