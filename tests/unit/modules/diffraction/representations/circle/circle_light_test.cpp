#include "modules/diffraction/representations/circle/circle_light.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

#include "engine/lighting/environment_map.h"
#include "modules/diffraction/representations/circle/circle_chart.h"

namespace rowland::diffraction {
namespace {

/// A sample in each texel of a cube map.
lighting::LightSamples uniform_light(int face_size) {
    lighting::LightSamples samples;
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < face_size; ++row)
            for (int column = 0; column < face_size; ++column)
                samples.push_back(glm::normalize(lighting::cube_direction(face, (2 * column + 1.0) / face_size - 1.0,
                                                                          (2 * row + 1.0) / face_size - 1.0)),
                                  glm::dvec3(lighting::cube_solid_angle(face_size, column, row)));
    return samples;
}

glm::dvec3 flux_of(const ImageLight& light, std::size_t image) {
    glm::dvec3 flux;
    for (int c = 0; c < 3; ++c) flux[c] = light.flux[2 * static_cast<std::size_t>(c) + image / 4][image % 4];
    return flux;
}

TEST(CircleLight, LightOfAnyResolutionIsOneSampleForEachCell) {
    for (const int cells : {kCircleLightCells, 40}) {
        const auto side = static_cast<std::size_t>(cells) + 2;
        for (const int face_size : {128, 256})
            EXPECT_LE(circle_light(uniform_light(face_size), cells).size(), 6 * side * side);
    }
}

/// Each keeps its mean direction and spreads alike, wherever it lies among the cells: the map's filling relies on it. A
/// cell is up to a quarter smaller along an axis away from a face's middle.
TEST(CircleLight, LampsKeepTheirMeanDirectionAndSpreadAlike) {
    const double largest = circle_light_variance(kCircleLightCells);
    double sum = 0.0;
    constexpr int kLamps = 400;
    for (int i = 0; i < kLamps; ++i) {
        const double y = 2.0 * (i + 0.5) / kLamps - 1.0;
        const double r = std::sqrt(1.0 - y * y);
        const glm::dvec3 lamp(r * std::cos(2.4 * i), y, r * std::sin(2.4 * i));
        lighting::LightSamples light;
        light.push_back(lamp, glm::dvec3(1.0));
        glm::dvec3 mean(0.0);
        double spread = 0.0;
        for (const ImageLight& cell : circle_light(light)) {
            const glm::dvec3 s(cell.direction);
            mean += flux_of(cell, 0).x * s;
            spread += flux_of(cell, 0).x * glm::dot(s - lamp, s - lamp);
        }
        EXPECT_LT(glm::distance(glm::normalize(mean), lamp), 2e-4) << i;
        EXPECT_LT(spread, 3.2 * largest) << i;  // a tent between two cells: up to ¼ h² = 1.5 times its mean, h²/6
        sum += spread / kLamps;
    }
    EXPECT_NEAR(sum, 2.0 * largest, 0.4 * largest);
}

/// The residual of a probe less its key lights is negative in places.
TEST(CircleLight, NegativeFluxIsKept) {
    lighting::LightSamples light = uniform_light(256);
    light.push_back(glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(-3.0));
    glm::dvec3 sum(0.0);
    glm::dvec3 of_cells(0.0);
    for (std::size_t i = 0; i < light.size(); ++i) sum += light.flux(i);
    for (const ImageLight& cell : circle_light(light)) of_cells += flux_of(cell, 0);
    EXPECT_LT(glm::distance(of_cells, sum), 1e-4);
}

/// Each direction holds what comes from its images, which are directions themselves.
TEST(CircleLight, ImagesAreTheLightFromTurnedDirections) {
    lighting::LightSamples light;
    light.push_back(glm::normalize(glm::dvec3(0.3, 0.5, -0.8)), glm::dvec3(1.0, 2.0, 4.0));
    light.push_back(glm::normalize(glm::dvec3(-0.9, 0.1, 0.2)), glm::dvec3(3.0, 2.0, 1.0));
    const std::vector<ImageLight> cells = circle_light(light);
    const auto key_of = [](const glm::dvec3& s) {
        return std::array{std::lround(1e4 * s.x), std::lround(1e4 * s.y), std::lround(1e4 * s.z)};
    };
    std::map<std::array<long, 3>, glm::dvec3> by_direction;
    for (const ImageLight& cell : cells) by_direction[key_of(cell.direction)] = flux_of(cell, 0);
    EXPECT_EQ(by_direction.size(), cells.size());
    for (const ImageLight& cell : cells)
        for (std::size_t image = 0; image < kCircleImages; ++image)
            EXPECT_EQ(flux_of(cell, image), by_direction[key_of(circle_image(cell.direction, image))]) << image;
}

}  // namespace
}  // namespace rowland::diffraction
