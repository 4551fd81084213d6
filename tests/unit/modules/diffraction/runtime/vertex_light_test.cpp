#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <span>

#include "engine/math/spherical_harmonics.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/bake/arc_moments.h"
#include "modules/diffraction/runtime/vertex_light.h"

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

lighting::ShLight random_light(int bands) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    lighting::ShLight light{.bands = bands, .coefficients = {}};
    for (int i = 0; i < bands * bands; ++i)
        light.coefficients.emplace_back(uniform(random), uniform(random), uniform(random));
    return light;
}

/// Vertices of random frames and both signs of the bitangent.
scene::Mesh random_mesh(std::size_t vertices) {
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    const auto direction = [&] { return glm::normalize(glm::vec3(normal(random), normal(random), normal(random))); };
    scene::Mesh mesh;
    for (std::size_t i = 0; i < vertices; ++i) {
        mesh.normals.push_back(direction());
        const glm::vec3 along = direction();
        mesh.tangents.emplace_back(glm::normalize(along - mesh.normals[i] * glm::dot(mesh.normals[i], along)),
                                   i % 2 == 0 ? 1.0F : -1.0F);
    }
    return mesh;
}

/// Against light_products() in each vertex's frame. Of the largest product 1e-5: the frames' changes are float.
void expect_products(const ArcTable& table, const glm::mat4& matrix, double groove_rotation) {
    const ArcProducts products(table, glm::dmat3(1.0));
    const lighting::ShLight light = random_light(table.bands);
    const scene::Mesh mesh = random_mesh(300);  // more than one block
    const std::vector<glm::vec4> all = products(light, mesh, matrix, groove_rotation);
    const auto stride = static_cast<std::size_t>(3 * products.layers());
    ASSERT_EQ(all.size(), stride * mesh.normals.size());
    double largest = 0.0;
    double difference = 0.0;
    for (std::size_t vertex = 0; vertex < mesh.normals.size(); ++vertex) {
        const glm::dmat3 frame = tangent_frame(mesh.normals[vertex], mesh.tangents[vertex], matrix, groove_rotation);
        lighting::ShLight rotated = light;
        math::ShRotation(frame, light.bands)
            .apply(std::span<const glm::dvec3>(light.coefficients), rotated.coefficients);
        const std::vector<glm::dvec3> expected = table.terms == LightTerms::ArcMoments
                                                     ? light_products(table, ArcMoments(table.bands)(rotated))
                                                     : light_products(table, rotated.coefficients);
        for (std::size_t r = 0; r < expected.size(); ++r)
            for (int o = 0; o < 3; ++o) {
                const glm::vec4& four = all[vertex * stride + 3 * (r / 4) + static_cast<std::size_t>(o)];
                largest = std::max(largest, std::abs(expected[r][o]));
                difference = std::max(difference, std::abs(expected[r][o] - static_cast<double>(four[int(r % 4)])));
            }
    }
    EXPECT_GT(largest, 0.0);
    EXPECT_LT(difference, 1e-5 * largest);
}

ArcTable table_of(const GrooveLobe& lobe, int rank) {
    Grating grating{.pitch_nm = 1600.0, .profile = SlitProfile{.width_nm = 800.0}};
    grating.lobe = lobe;
    ArcSettings settings{.bands = 4, .rank = rank};
    settings.grid = is_flat(lobe) ? ViewGrid{.mapping = ViewMapping::OneDimensional, .columns = 32, .rows = 1}
                                  : ViewGrid{.mapping = ViewMapping::Parabolic, .columns = 8, .rows = 8};
    return bake(grating, settings);
}

TEST(ArcProducts, EqualTheTablesOwnInEveryVertexFrame) {
    const glm::mat4 turned = glm::rotate(glm::mat4(1.0F), 0.7F, glm::normalize(glm::vec3(1.0F, 2.0F, -0.4F)));
    for (const double rotation : {0.0, 0.9}) {
        expect_products(table_of(FlatLobe{}, 6), turned, rotation);
        expect_products(table_of(GaussianLobe{0.3}, 9), turned, rotation);
    }
}

TEST(ArcProducts, FollowStretchedAndMirroredObjects) {
    const glm::mat4 stretched = glm::scale(glm::mat4(1.0F), glm::vec3(1.0F, 1.4F, 0.7F));
    const glm::mat4 mirrored = glm::scale(stretched, glm::vec3(-1.0F, 1.0F, 1.0F));
    for (const glm::mat4& matrix : {stretched, mirrored})
        for (const double rotation : {0.0, -0.6}) expect_products(table_of(FlatLobe{}, 6), matrix, rotation);
}

/// Any light, of every band.
lighting::ShLight some_light(int bands) {
    lighting::ShLight light{.bands = bands, .coefficients = {}};
    for (int i = 0; i < math::sh_count(bands); ++i)
        light.coefficients.emplace_back(std::sin(1.0 + i), std::cos(2.0 * i), 0.3 + std::sin(0.7 * i));
    return light;
}

/// The series against the products of a vertex with that grating vector, for lobes with arc moments and without. 1e-5:
/// single precision.
TEST(ArcTurns, HoldTheProductsOfEveryGratingVectorOfThePlane) {
    for (const int bands : {1, 2, 5, 8})
        for (const bool flat : {true, false}) {
            Grating grating;
            grating.pitch_nm = 1300.0;
            grating.profile = BlazedProfile{.depth_nm = 250.0};
            if (!flat) grating.lobe = GaussianLobe{0.3};
            ArcSettings settings{.bands = bands, .rank = 6};
            if (!flat) settings.grid = ViewGrid{.mapping = ViewMapping::Parabolic, .columns = 12, .rows = 12};
            const ArcProducts products(bake(grating, settings), glm::dmat3(1.0));
            const lighting::ShLight light = some_light(bands);
            const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
            const ArcTurns turns = arc_turns(products, light, normal);
            const std::size_t vectors = 3 * static_cast<std::size_t>(products.layers());
            ASSERT_EQ(turns.terms.size(), (2 * static_cast<std::size_t>(bands) - 1) * vectors);
            for (const double azimuth : {0.0, 0.4, 2.9, 5.1}) {
                scene::Mesh vertex;
                vertex.normals = {glm::vec3(normal)};
                vertex.tangents = {
                    glm::vec4(glm::vec3(std::cos(azimuth) * turns.e1 + std::sin(azimuth) * turns.e2), 1.0F)};
                const std::vector<glm::vec4> expected = products(light, vertex, glm::mat4(1.0F), 0.0);
                float largest = 0.0F;
                for (const glm::vec4& value : expected) largest = std::max(largest, glm::length(value));
                for (std::size_t i = 0; i < vectors; ++i) {
                    glm::dvec4 sum(turns.terms[i]);
                    for (std::size_t m = 1; m < static_cast<std::size_t>(bands); ++m) {
                        const double angle = static_cast<double>(m) * azimuth;
                        sum += std::cos(angle) * glm::dvec4(turns.terms[(2 * m - 1) * vectors + i]) +
                               std::sin(angle) * glm::dvec4(turns.terms[2 * m * vectors + i]);
                    }
                    EXPECT_LT(glm::distance(glm::vec4(sum), expected[i]), 1e-5F * largest) << bands << " " << azimuth;
                }
            }
        }
}

}  // namespace
}  // namespace rowland::diffraction
