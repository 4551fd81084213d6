#include "modules/diffraction/representations/planar/light_disc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace rowland::diffraction {
namespace {

/// Lamps all around, at the horizon and just above it: their cells are the outermost.
TEST(LightDisc, LitColumnsHoldAllOfTheLight) {
    lighting::LightSamples lamps;
    for (int i = 0; i < 1000; ++i)
        for (const double height : {0.001, 0.02, 0.1})
            lamps.push_back(glm::normalize(glm::dvec3(std::cos(0.1 * i), height, std::sin(0.1 * i))), glm::dvec3(1.0));
    for (const int cells : {16, 63, 256}) {
        const LightDisc disc = light_on_disc(lamps, plane_axes({0, 1, 0}), std::nullopt, cells);
        double sum = 0.0;
        for (int row = 0; row < cells; ++row) {
            const auto [begin, end] = lit_columns(cells, row);
            for (int column = begin; column < end; ++column)
                sum += static_cast<double>(disc.fluxes[static_cast<std::size_t>(4 * (row * cells + column))]);
        }
        double expected = 0.0;
        for (const float y : lamps.y) expected += 0.5 * static_cast<double>(y);
        EXPECT_NEAR(sum, expected, 1e-5 * expected) << cells;
    }
}

}  // namespace
}  // namespace rowland::diffraction
