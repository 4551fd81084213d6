#include "modules/diffraction/representations/circle/circle_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>

#include "engine/lighting/environment_map.h"

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

glm::dvec3 flux_of(const lighting::LightSamples& samples) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < samples.size(); ++i) sum += samples.flux(i);
    return sum;
}

TEST(CircleLight, SoftLightIsOneSampleForEachCell) {
    EXPECT_EQ(circle_light(uniform_light(256)).size(), 6U * 64U * 64U);
}

/// .01 rad apart, in one cell of .025 rad: both keep their directions and fluxes, and only their cell is divided.
TEST(CircleLight, LampsInOneCellStayApart) {
    lighting::LightSamples light = uniform_light(256);
    const glm::dvec3 lamps[] = {glm::normalize(glm::dvec3(1.0, 0.007, 0.012)),
                                glm::normalize(glm::dvec3(1.0, 0.017, 0.012))};
    for (const glm::dvec3& lamp : lamps) light.push_back(lamp, glm::dvec3(1.0));
    const lighting::LightSamples samples = circle_light(light);
    EXPECT_EQ(samples.size(), 6U * 64U * 64U + 15U);
    EXPECT_LT(glm::distance(flux_of(samples), flux_of(light)), 1e-4);
    for (const glm::dvec3& lamp : lamps) {
        double nearest = 1.0;
        for (std::size_t i = 0; i < samples.size(); ++i)
            if (samples.flux(i).x > 0.9) nearest = std::min(nearest, glm::distance(samples.direction(i), lamp));
        EXPECT_LT(nearest, 1e-4);
    }
}

/// The residual of a probe less its key lights is negative in places.
TEST(CircleLight, NegativeFluxIsKept) {
    lighting::LightSamples light = uniform_light(256);
    light.push_back(glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(-3.0));
    EXPECT_LT(glm::distance(flux_of(circle_light(light)), flux_of(light)), 1e-4);
}

}  // namespace
}  // namespace rowland::diffraction
