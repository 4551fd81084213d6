#include "engine/lighting/key_lights.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "engine/math/quadrature.h"
#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {
namespace {

using std::numbers::pi;

const glm::dvec3 kDirection = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));

/// Mean over a lobe of a function of the direction: shells of equal power (the cumulative distribution in
/// cos θ inverts in closed form), each a circle of even angles.
template <typename Function>
double lobe_mean(const KeyLight& key, const Function& function) {
    const glm::dvec3 side = glm::normalize(glm::cross(key.direction, glm::dvec3(1.0, 0.1, 0.2)));
    const glm::dvec3 other = glm::cross(key.direction, side);
    const math::QuadratureRule rule = math::gauss_legendre(200, 0.0, 1.0);
    constexpr int kAngles = 400;
    double mean = 0.0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double cosine =
            std::max(-1.0, 1.0 + std::log1p(rule.nodes[i] * std::expm1(-2.0 * key.concentration)) / key.concentration);
        const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
        for (int j = 0; j < kAngles; ++j) {
            const double angle = 2.0 * pi * (j + 0.5) / kAngles;
            mean += rule.weights[i] / kAngles *
                    function(cosine * key.direction + sine * (std::cos(angle) * side + std::sin(angle) * other));
        }
    }
    return mean;
}

/// ∫ density over the sphere, by Gauss–Legendre in cos θ on the part that a double can see of the lobe.
TEST(KeyLights, DensityIntegratesToOne) {
    for (const double concentration : {1e-3, 0.5, 10.0, 1e3, 1e5, 1e6}) {
        const KeyLight key{kDirection, glm::dvec3(1.0), concentration};
        const glm::dvec3 side = glm::normalize(glm::cross(kDirection, glm::dvec3(1.0, 0.0, 0.0)));
        const math::QuadratureRule rule = math::gauss_legendre(60, 0.0, std::min(2.0, 40.0 / concentration));
        double sum = 0.0;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const double cosine = 1.0 - rule.nodes[i];
            const double sine = std::sqrt(rule.nodes[i] * (2.0 - rule.nodes[i]));
            sum += 2.0 * pi * rule.weights[i] * lobe_density(key, cosine * kDirection + sine * side);
        }
        EXPECT_NEAR(sum, 1.0, 1e-9) << concentration;  // s has rounding of 1e-16, which κ multiplies
    }
}

TEST(KeyLights, BandFactorsAreTheLobesLegendreMeans) {
    for (const double concentration : {1e-3, 0.3, 5.0, 60.0, 119.0, 121.0, 1e3}) {
        const KeyLight key{kDirection, glm::dvec3(1.0), concentration};
        const std::vector<double> factors = lobe_band_factors(concentration, 8);
        for (std::size_t l = 0; l < factors.size(); ++l) {
            const double mean = lobe_mean(key, [&](const glm::dvec3& s) {
                return std::legendre(static_cast<unsigned>(l), glm::dot(s, kDirection));
            });
            // Quadrature across the logarithm that inverts the distribution: 1e-5.
            EXPECT_NEAR(factors[l], mean, 2e-5) << concentration << " band " << l;
        }
    }
}

/// Both recurrences meet where one takes over from the other, and obey I_{l−1} − I_{l+1} = (2l+1)/κ I_l.
TEST(KeyLights, BandFactorsObeyTheRecurrenceTo32Bands) {
    for (const double concentration : {1e-3, 1.0, 40.0, 119.9, 120.1, 1e3, 1e5, 1e6}) {
        const std::vector<double> f = lobe_band_factors(concentration, 32);
        EXPECT_EQ(f[0], 1.0);
        for (std::size_t l = 1; l + 1 < f.size(); ++l) {
            EXPECT_GE(f[l], 0.0);
            EXPECT_LE(f[l], f[l - 1]);
            const double rise = static_cast<double>(2 * l + 1) / concentration * f[l];
            EXPECT_NEAR(f[l - 1] - f[l + 1], rise, 1e-12 * f[l - 1] + 1e-12 * rise) << concentration << " " << l;
        }
    }
    const auto below = lobe_band_factors(120.0, 32);
    const auto above = lobe_band_factors(std::nextafter(120.0, 200.0), 32);
    for (std::size_t l = 0; l < below.size(); ++l) EXPECT_NEAR(below[l], above[l], 1e-10 * below[l]) << l;
}

/// The stated error of the normal approximation: measured .0010 at κ = 25, .0037 at 10, .023 at worst (κ = 1).
TEST(KeyLights, IrradianceIsTheLobesClampedCosine) {
    const struct {
        double concentration;
        double tolerance;
    } cases[] = {{0.01, 0.024}, {1.0, 0.024}, {10.0, 0.004}, {25.0, 0.0011}, {100.0, 2e-4}, {1e4, 1e-5}};
    for (const auto& one : cases)
        for (int i = 0; i <= 16; ++i) {
            const double angle = pi * i / 16;
            const glm::dvec3 side = glm::normalize(glm::cross(kDirection, glm::dvec3(0.0, 0.0, 1.0)));
            const glm::dvec3 n = std::cos(angle) * kDirection + std::sin(angle) * side;
            const KeyLight key{kDirection, glm::dvec3(2.0, 1.0, 0.5), one.concentration};
            const double exact = lobe_mean(key, [&](const glm::dvec3& s) { return std::max(0.0, glm::dot(s, n)); });
            const glm::dvec3 irradiance = LobeIrradiance({&key, 1})(n);
            EXPECT_NEAR(irradiance.x, 2.0 * exact, 2.0 * one.tolerance) << one.concentration << " " << i;
            EXPECT_GE(irradiance.x, 0.0);
        }
}

TEST(KeyLights, ResidualAndLobesAreTheProbe) {
    ShLight probe{.bands = 5, .coefficients = std::vector<glm::dvec3>(25, glm::dvec3(0.7, 0.5, 0.1))};
    const std::vector<KeyLight> keys{{kDirection, {3.0, 2.0, 1.0}, 80.0}, {{0.0, 0.0, 1.0}, {0.5, 0.5, 0.6}, 900.0}};
    const ShLight left = residual(probe, keys, 5);
    const ShLight lobes = project(keys, 5);
    for (std::size_t i = 0; i < 25; ++i)
        EXPECT_LT(glm::length(left.coefficients[i] + lobes.coefficients[i] - probe.coefficients[i]), 1e-14);
    // Band 0 is the flux over √(4π).
    EXPECT_NEAR(lobes.coefficients[0].x, 3.5 / std::sqrt(4.0 * pi), 1e-13);
}

/// Lobes on a dim ground.
ProbeImage probe_of(const std::vector<KeyLight>& lobes, int height) {
    return test::made_probe(Mapping::Equirectangular, height, [&](const glm::dvec3& d) {
        glm::dvec3 radiance(0.1);
        for (const KeyLight& lobe : lobes) radiance += lobe_density(lobe, d) * lobe.flux;
        return radiance;
    });
}

/// Their positions to a fifth of a texel, their flux to 5 % (the ground's own light under the lobes is 1 %).
TEST(FitKeyLights, FindsTheLobesAProbeIsMadeOf) {
    const ProbeImage probe = probe_of(
        {{kDirection, {4.0, 3.0, 2.0}, 200.0}, {glm::normalize(glm::dvec3(-0.9, -0.2, 0.3)), {1.0, 2.0, 1.0}, 600.0}},
        128);
    const std::vector<KeyLight> keys = fit_key_lights(probe, 2);
    ASSERT_EQ(keys.size(), 2U);
    EXPECT_LT(glm::length(keys[0].direction - kDirection), 0.005);
    EXPECT_LT(glm::length(keys[0].flux - glm::dvec3(4.0, 3.0, 2.0)), 0.05 * glm::length(glm::dvec3(4.0, 3.0, 2.0)));
    EXPECT_NEAR(keys[0].concentration, 200.0, 30.0);
    EXPECT_LT(glm::length(keys[1].direction - glm::normalize(glm::dvec3(-0.9, -0.2, 0.3))), 0.005);
    EXPECT_NEAR(keys[1].concentration, 600.0, 150.0);
}

/// A broad glow shows in the exact bands, a dimmer lamp does not.
TEST(FitKeyLights, WhatMattersMostComesFirst) {
    const std::vector<KeyLight> lobes{{kDirection, glm::dvec3(4.0), 42.0},
                                      {glm::normalize(glm::dvec3(-0.9, 0.2, 0.3)), glm::dvec3(3.5), 500.0}};
    const std::vector<KeyLight> keys = fit_key_lights(probe_of(lobes, 64), 2);
    ASSERT_EQ(keys.size(), 2U);
    EXPECT_GT(glm::dot(keys[0].direction, lobes[1].direction), 0.99);
    EXPECT_LT(keys[0].flux.x, keys[1].flux.x);
}

/// Lamps of one texel, .012 rad, before a dim wall: each is one light, no wider than its texel.
TEST(FitKeyLights, LampsOfATexelStayLampsOfATexel) {
    constexpr int kWidth = 512;
    image::Image image{.width = kWidth, .height = kWidth / 2, .texels = {}};
    image.texels.resize(std::size_t{kWidth} * kWidth / 2, glm::vec3(0.1F));
    const glm::ivec2 lamps[] = {{100, 120}, {130, 120}, {300, 90}, {301, 180}};
    for (const glm::ivec2& lamp : lamps) image.at(lamp.x, lamp.y) = glm::vec3(2e4F, 1e4F, 1e4F);
    const ProbeImage probe(image, Mapping::Equirectangular);
    const std::vector<KeyLight> keys = fit_key_lights(probe, 4);
    ASSERT_EQ(keys.size(), 4U);
    const double side = 2.0 * pi / kWidth;
    for (const glm::ivec2& lamp : lamps) {
        const glm::dvec3 direction = probe.direction(lamp.x + 0.5, lamp.y + 0.5);
        const auto key = std::max_element(keys.begin(), keys.end(), [&](const KeyLight& a, const KeyLight& b) {
            return glm::dot(a.direction, direction) < glm::dot(b.direction, direction);
        });
        EXPECT_LT(glm::distance(key->direction, direction), 0.1 * side);
        const double flux = 2e4 * probe.solid_angle(lamp.x, lamp.y);
        EXPECT_NEAR(key->flux.x, flux, 0.02 * flux);
        EXPECT_GT(key->concentration, 1.0 / (side * side));
    }
}

/// Light that varies slowly lies in the bands that do not count, unless fewer are left out.
TEST(FitKeyLights, LeavesTheExactBandsAlone) {
    const ProbeImage probe =
        test::made_probe(Mapping::Equirectangular, 32, [](const glm::dvec3& d) { return glm::dvec3(1.0 + d.x); });
    const auto flux = [&](const KeyLightFit& settings) {
        double sum = 0.0;
        for (const KeyLight& key : fit_key_lights(probe, 4, settings)) sum += key.flux.x;
        return sum / (4 * pi);
    };
    EXPECT_LT(flux({.exact_bands = 5}), 0.01);
    EXPECT_GT(flux({.exact_bands = 1}), 0.05);
}

TEST(FitKeyLights, BlackAndUniformProbesHaveNone) {
    const auto uniform = [](double radiance) {
        return test::made_probe(Mapping::Equirectangular, 16, [&](const glm::dvec3&) { return glm::dvec3(radiance); });
    };
    EXPECT_TRUE(fit_key_lights(uniform(0.0), 16).empty());
    EXPECT_TRUE(fit_key_lights(uniform(1.0), 0).empty());
    // The light cells' own unevenness is all there is to fit.
    glm::dvec3 flux(0.0);
    for (const KeyLight& key : fit_key_lights(uniform(1.0), 4)) flux += key.flux;
    EXPECT_LT(flux.x, 0.01 * 4.0 * pi);
}

}  // namespace
}  // namespace rowland::lighting
