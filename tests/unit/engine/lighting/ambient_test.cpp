#include "engine/lighting/ambient.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/math/sh_basis.h"
#include "tests/support/evaluate_irradiance.h"
#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {
namespace {

using std::numbers::pi;

/// SH of a point light of unit irradiance in direction d.
ShLight point_light(const glm::dvec3& d, double ambient_radiance) {
    ShLight light{4, std::vector<glm::dvec3>(16)};
    std::vector<double> y(16);
    math::evaluate_sh(d, 4, y);
    for (std::size_t i = 0; i < y.size(); ++i) light.coefficients[i] = glm::dvec3(y[i]);
    light.coefficients[0] += ambient_radiance * std::sqrt(4 * pi);
    return light;
}

double lowest(const AmbientLight& ambient) {
    double value = 1e30;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 e = test::evaluate_irradiance(ambient, test::spread_direction(i, 20000));
        value = std::min({value, e.x, e.y, e.z});
    }
    return value;
}

TEST(Ambient, WhiteFurnaceIsOne) {
    for (const Mapping mapping : test::kMappings) {
        const AmbientLight ambient = ambient_coefficients(project(test::constant_probe(mapping, 128), 5));
        EXPECT_EQ(ambient.window.window, math::SphericalWindow::None);
        EXPECT_EQ(ambient.window.damping, 0);
        for (int i = 0; i < 50; ++i)
            // The projection's own error at this size.
            EXPECT_NEAR(test::evaluate_irradiance(ambient, test::spread_direction(i, 50)).y, 1, 1e-3);
    }
}

TEST(Ambient, AgreesWithBruteForceIrradianceForSmoothLight) {
    // Light of three bands: nine terms are exact, whatever the projection keeps.
    const ProbeImage probe = test::made_probe(Mapping::Equirectangular, 64, [](const glm::dvec3& d) {
        return glm::dvec3(2 + d.x, 2 + d.y * d.z, 3 - d.z + d.x * d.x);
    });
    const AmbientLight ambient = ambient_coefficients(project(probe, 5));
    ASSERT_EQ(ambient.window.window, math::SphericalWindow::None);
    for (int i = 0; i < 30; ++i) {
        const glm::dvec3 n = test::spread_direction(i, 30);
        glm::dvec3 sum(0.0);
        for (int row = 0; row < 64; ++row)
            for (int column = 0; column < 128; ++column) {
                const double cosine = glm::dot(n, probe.direction(column + 0.5, row + 0.5));
                if (cosine > 0)
                    sum += cosine * probe.solid_angle(column, row) / pi * glm::dvec3(probe.image().at(column, row));
            }
        // Midpoint sums over texels of 2.8°, with a kink at the horizon.
        EXPECT_LT(glm::length(test::evaluate_irradiance(ambient, n) - sum), 0.005);
    }
}

TEST(Ambient, CosineLobeIsConvolvedWithTheCosine) {
    // Light max(0, cos) around g. E/π at angle β from g is (sin β + (π − β) cos β) · 2 / (3π): the cosine lobe's
    // autocorrelation (Lambert's sphere phase function). Three bands carry it to 1 %, but dip to −.005 behind: a little
    // light all around spares the window.
    constexpr double kAround = 0.05;
    const glm::dvec3 g = glm::normalize(glm::dvec3(1, 2, -0.5));
    const ProbeImage probe = test::made_probe(Mapping::Equirectangular, 128, [&](const glm::dvec3& d) {
        return glm::dvec3(kAround + std::max(0.0, glm::dot(g, d)));
    });
    const AmbientLight ambient = ambient_coefficients(project(probe, 5));
    ASSERT_EQ(ambient.window.window, math::SphericalWindow::None);
    const glm::dvec3 side = glm::normalize(glm::cross(g, glm::dvec3(0, 0, 1)));
    for (const double beta : {0.0, 0.7, pi / 2, 2.2}) {
        const double exact = kAround + (std::sin(beta) + (pi - beta) * std::cos(beta)) * 2 / (3 * pi);
        const glm::dvec3 n = std::cos(beta) * g + std::sin(beta) * side;
        EXPECT_NEAR(test::evaluate_irradiance(ambient, n).x, exact, 0.01) << beta;
    }
}

TEST(Ambient, MildestWindowThatKeepsItNonNegativeIsPicked) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(1, 1, -2));
    // Radiance 1/4π all around is what a point light of irradiance 1 spreads over the sphere on average.
    const auto picked = [&](double irradiance) { return ambient_coefficients(point_light(d, irradiance / (4 * pi))); };
    const AmbientLight bright = picked(2);
    EXPECT_EQ(bright.window.window, math::SphericalWindow::None);
    EXPECT_EQ(bright.window.damping, 0);

    // Unwindowed it dips to −.158 of the mean, under Lanczos to −.137.
    const AmbientLight dusk = picked(0.148);
    EXPECT_EQ(dusk.window.window, math::SphericalWindow::Lanczos);
    EXPECT_GE(lowest(dusk), 0);

    const AmbientLight night = picked(0);
    EXPECT_GT(night.window.damping, 0);
    EXPECT_GE(lowest(night), 0);
    EXPECT_GT(test::evaluate_irradiance(night, d).x, test::evaluate_irradiance(night, -d).x);
}

TEST(Ambient, WhatLobesLeaveMayBeNegativeWhereTheSumIsNot) {
    // An even light less a lobe that is as bright on average: −d reflects the difference of the two.
    const glm::dvec3 d = glm::normalize(glm::dvec3(1, 1, -2));
    const std::vector<KeyLight> keys{{d, glm::dvec3(4 * pi), 40.0}};
    const ShLight even{3, {glm::dvec3(2 * std::sqrt(4 * pi)), {}, {}, {}, {}, {}, {}, {}, {}}};
    const ShLight left = residual(even, keys, 3);
    EXPECT_TRUE(ambient_coefficients(left).window.window != math::SphericalWindow::None ||
                ambient_coefficients(left).window.damping > 0);
    const AmbientLight ambient = ambient_coefficients(left, keys);
    EXPECT_EQ(ambient.window.window, math::SphericalWindow::None);
    EXPECT_EQ(ambient.window.damping, 0);
    // The sum is the even light again, but for the lobe's bands from 4 on, E/π = flux A_l (2l+1)/4π² each under the
    // lobe: −0.29 of band 4 and 0.12 of band 6.
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 n = test::spread_direction(i, 50);
        EXPECT_NEAR(test::evaluate_irradiance(ambient, n).x + irradiance(keys[0], n).x / pi, 2.0, 0.35) << i;
    }
}

TEST(Ambient, FewerThanThreeBandsCountAsZeros) {
    const ShLight light{1, {glm::dvec3(std::sqrt(4 * pi))}};
    EXPECT_NEAR(test::evaluate_irradiance(ambient_coefficients(light), {0, 0, 1}).x, 1, 1e-14);
}

TEST(Ambient, DarknessStaysDark) {
    const ShLight light{3, std::vector<glm::dvec3>(9, glm::dvec3(0.0))};
    EXPECT_EQ(test::evaluate_irradiance(ambient_coefficients(light), {0, 1, 0}), glm::dvec3(0.0));
}

}  // namespace
}  // namespace rowland::lighting
