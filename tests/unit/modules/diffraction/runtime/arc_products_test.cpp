#include "modules/diffraction/representations/arc/arc_products.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <span>

#include "engine/math/sh_rotation.h"
#include "modules/diffraction/bake/arc_moments.h"
#include "modules/diffraction/runtime/tangent_light.h"

namespace rowland::diffraction {
namespace {

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

}  // namespace
}  // namespace rowland::diffraction
