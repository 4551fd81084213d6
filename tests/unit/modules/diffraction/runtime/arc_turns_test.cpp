#include "modules/diffraction/representations/arc/arc_turns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/math/sh_basis.h"
#include "engine/scene/mesh.h"

namespace rowland::diffraction {
namespace {

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
