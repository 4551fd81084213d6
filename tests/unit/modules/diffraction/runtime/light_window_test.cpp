#include "modules/diffraction/runtime/light_window.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "engine/math/sh_basis.h"

namespace rowland::diffraction {
namespace {

/// A point lamp over even light of radiance `ambient`.
lighting::ShLight lamp(int bands, double ambient) {
    std::vector<double> basis(static_cast<std::size_t>(math::sh_count(bands)));
    math::evaluate_sh(glm::normalize(glm::dvec3(0.3, 0.8, 0.5)), bands, basis);
    lighting::ShLight light{.bands = bands, .coefficients = {}};
    for (const double y : basis) light.coefficients.emplace_back(y);
    light.coefficients[0] += glm::dvec3(ambient / basis[0]);
    return light;
}

TEST(LightWindow, EvenLightDoesNotRing) {
    EXPECT_EQ(ringing(lamp(5, 100.0)), 0.0);
    EXPECT_EQ(weakest_window(lamp(5, 100.0), 5), math::SphericalWindow::None);
}

TEST(LightWindow, ALampInADarkRoomRingsAndIsWindowed) {
    for (const int bands : {5, 8, 12}) {
        const lighting::ShLight light = lamp(bands, 0.01);
        EXPECT_GT(ringing(light), 0.1);
        const math::SphericalWindow window = weakest_window(light, bands);
        EXPECT_NE(window, math::SphericalWindow::None);
        EXPECT_LT(ringing(lighting::limit_bands(light, bands, window)), 0.5 * ringing(light));
    }
}

TEST(LightWindow, LightOfTheWrongSignRingsWholly) {
    lighting::ShLight dark = lamp(3, 100.0);
    for (glm::dvec3& coefficient : dark.coefficients) coefficient = -coefficient;
    EXPECT_EQ(ringing(dark), 1.0);
}

TEST(LightWindow, NoLightDoesNotRing) {
    EXPECT_EQ(ringing({.bands = 4, .coefficients = std::vector<glm::dvec3>(16, glm::dvec3(0.0))}), 0.0);
}

}  // namespace
}  // namespace rowland::diffraction
