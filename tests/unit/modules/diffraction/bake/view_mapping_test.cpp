#include "modules/diffraction/bake/view_mapping.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "engine/core/error.h"

namespace rowland::diffraction {
namespace {

const std::vector<ViewGrid> kGrids = {{ViewMapping::Spherical, 9, 5},
                                      {ViewMapping::Spherical, 8, 4},
                                      {ViewMapping::Parabolic, 7, 8},
                                      {ViewMapping::OneDimensional, 11, 1}};

/// A node above the horizon is found again, with weight 1 (4 ulp of an angle are 1e-14 of a node).
TEST(ViewMapping, NodesLieOnTheirTexels) {
    for (const ViewGrid& grid : kGrids)
        for (int row = 0; row < grid.rows; ++row)
            for (int column = 0; column < grid.columns; ++column) {
                const glm::dvec2 v = node_view(grid, column, row);
                EXPECT_LE(glm::length(v), 1.0 + 1e-15);
                if (grid.mapping == ViewMapping::Parabolic) {
                    const double p_g = 2.0 * column / (grid.columns - 1) - 1.0;
                    const double p_h = 2.0 * row / (grid.rows - 1) - 1.0;
                    if (p_g * p_g + p_h * p_h > 1.0) continue;
                }
                if (grid.mapping == ViewMapping::Spherical && row == 0) continue;  // n has no azimuth
                const double v_n = std::sqrt(std::max(1.0 - glm::dot(v, v), 0.0));
                const BilinearLookup found = look_up(grid, v.x, v.y, v_n);
                double weight = 0.0;
                for (std::size_t i = 0; i < 4; ++i)
                    if (found.texel[i] == static_cast<std::size_t>(row * grid.columns + column))
                        weight += found.weight[i];
                // A view at the horizon loses half its digits in v_n.
                EXPECT_NEAR(weight, 1.0, v_n < 1e-6 ? 1e-6 : 1e-12) << view_mapping_name(grid.mapping);
            }
}

TEST(ViewMapping, MirroredTexelsHoldMirroredViews) {
    for (const ViewGrid& grid : kGrids)
        for (int row = 0; row < grid.rows; ++row)
            for (int column = 0; column < grid.columns; ++column) {
                const auto mirror = static_cast<int>(mirrored_texel(grid, column, row));
                const glm::dvec2 v = node_view(grid, column, row);
                const glm::dvec2 w = node_view(grid, mirror % grid.columns, mirror / grid.columns);
                EXPECT_NEAR(w.x, v.x, 1e-15);
                EXPECT_NEAR(w.y, -v.y, 1e-15);
            }
}

TEST(ViewMapping, WeightsSumToOneAndStayInsideAnywhere) {
    for (const ViewGrid& grid : kGrids)
        for (int i = 1; i < 500; ++i) {
            const glm::dvec3 v = glm::normalize(glm::dvec3(std::sin(1.0 * i), std::sin(2.3 * i), std::sin(3.7 * i)));
            const BilinearLookup found = look_up(grid, v.x, v.y, v.z);
            EXPECT_NEAR(std::accumulate(found.weight.begin(), found.weight.end(), 0.0), 1.0, 1e-14);
            for (std::size_t k = 0; k < 4; ++k) {
                EXPECT_GE(found.weight[k], 0.0);
                EXPECT_LT(found.texel[k], grid.texels());
            }
        }
}

/// Reads back a number that is linear in the mapping's own coordinates: that is what GL_LINEAR does.
TEST(ViewMapping, ParabolicLookUpsAreLinearInTheParaboloid) {
    const ViewGrid grid{ViewMapping::Parabolic, 6, 5};
    for (int i = 1; i < 100; ++i) {
        const glm::dvec3 v =
            glm::normalize(glm::dvec3(std::sin(1.0 * i), std::sin(2.3 * i), std::abs(std::sin(3.7 * i))));
        const BilinearLookup found = look_up(grid, v.x, v.y, v.z);
        double column = 0.0;
        double row = 0.0;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t rows_before = found.texel[k] / 6;
            column += found.weight[k] * static_cast<double>(found.texel[k] % 6);
            row += found.weight[k] * static_cast<double>(rows_before);
        }
        EXPECT_NEAR(column, (v.x / (1.0 + v.z) + 1.0) / 2.0 * 5.0, 1e-12);
        EXPECT_NEAR(row, (v.y / (1.0 + v.z) + 1.0) / 2.0 * 4.0, 1e-12);
    }
}

TEST(ViewMapping, LooksUpSomethingForAViewThatIsNoNumber) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const ViewGrid& grid : kGrids)
        for (const std::size_t texel : look_up(grid, none, none, none).texel) EXPECT_LT(texel, grid.texels());
}

TEST(ViewMapping, RefusesOneDimensionForALobeAndForALattice) {
    const ViewGrid grid{ViewMapping::OneDimensional, 16, 1};
    Grating grating;
    EXPECT_NO_THROW(check_view_grid(grid, grating));
    grating.lobe = GaussianLobe{0.3};
    EXPECT_THROW(check_view_grid(grid, grating), Error);
    grating.lobe = FlatLobe{};
    grating.lattice.emplace();
    EXPECT_THROW(check_view_grid(grid, grating), Error);
}

}  // namespace
}  // namespace rowland::diffraction
