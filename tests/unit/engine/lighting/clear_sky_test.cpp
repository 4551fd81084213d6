#include "engine/lighting/clear_sky.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/lighting/probe_image.h"
#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {
namespace {

double luminance(const glm::dvec3& rgb) {
    return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

glm::dvec3 sun_of(const ClearSkyRecipe& recipe) {
    const double a = glm::radians(recipe.sun_azimuth_deg);
    const double e = glm::radians(recipe.sun_elevation_deg);
    return {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
}

TEST(ClearSky, SunDiscCarriesItsIrradianceAtAnySizeAndResolution) {
    for (const double diameter : {0.2, 0.533, 5.0})
        for (const double elevation : {1.0, 42.0, 90.0})
            for (const int width : {64, 512}) {
                ClearSkyRecipe recipe;
                recipe.sun_azimuth_deg = 171;  // its texels may straddle the image's edge
                recipe.sun_elevation_deg = elevation;
                recipe.sun_angular_diameter_deg = diameter;
                const ProbeImage probe(render_clear_sky(recipe, width), Mapping::Equirectangular);
                glm::dvec3 sum(0.0);
                for (int row = 0; row < probe.image().height / 2; ++row)
                    for (int column = 0; column < width; ++column) {
                        const glm::dvec3 sky = sky_radiance(recipe, probe.direction(column + 0.5, row + 0.5));
                        sum += probe.solid_angle(column, row) * (glm::dvec3(probe.image().at(column, row)) - sky);
                    }
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(sum[c] / sun_irradiance(recipe)[c], 1, 0.01) << diameter << ", " << elevation;
            }
}

TEST(ClearSky, SunStandsWhereItsAnglesSay) {
    ClearSkyRecipe recipe;
    recipe.sun_azimuth_deg = 90;
    recipe.sun_elevation_deg = 30;
    const ProbeImage probe(render_clear_sky(recipe, 512), Mapping::Equirectangular);
    const glm::dvec3 sun = sun_of(recipe);
    EXPECT_GT(sun.x, 0.8);
    double brightest = 0;
    glm::dvec3 where(0.0);
    for (int row = 0; row < 256; ++row)
        for (int column = 0; column < 512; ++column)
            if (probe.image().at(column, row).y > brightest) {
                brightest = probe.image().at(column, row).y;
                where = probe.direction(column + 0.5, row + 0.5);
            }
    EXPECT_GT(glm::dot(where, sun), std::cos(2 * std::numbers::pi / 512));
}

TEST(ClearSky, IsPlausibleDaylight) {
    ClearSkyRecipe recipe;
    recipe.sun_elevation_deg = 45;
    // Direct sun at 45°: 90–100 klx [IES RP-21: 127.5 exp(−.21·1.41) = 94.8].
    EXPECT_NEAR(luminance(sun_irradiance(recipe)), 94.8, 0.5);
    // Zenith luminance by the model's own formula with T = 3: 4.19 kcd/m².
    const double chi = (4.0 / 9 - 3.0 / 120) * (std::numbers::pi / 2);
    const double zenith = (4.0453 * 3 - 4.9710) * std::tan(chi) - 0.2155 * 3 + 2.4192;
    EXPECT_NEAR(luminance(sky_radiance(recipe, {0, 1, 0})), zenith, 0.01 * zenith);
    // F of Perez for Y, T = 3, at θ = 80° and 90° of azimuth from the sun, over F at the zenith: 1.1869 / 1.0250.
    const glm::dvec3 low_sky(std::sin(glm::radians(80.0)), std::cos(glm::radians(80.0)), 0);
    EXPECT_NEAR(luminance(sky_radiance(recipe, low_sky)), 1.1579 * zenith, 0.01 * zenith);
    // Blue away from the sun, and brighter toward it.
    const glm::dvec3 away = sky_radiance(recipe, glm::normalize(glm::dvec3(0, 1, 0.7)));
    EXPECT_GT(away.z, 1.5 * away.x);
    EXPECT_GT(luminance(sky_radiance(recipe, sun_of(recipe))), 3 * luminance(away));
    // A low sun is dimmer and redder.
    ClearSkyRecipe low = recipe;
    low.sun_elevation_deg = 5;
    EXPECT_LT(luminance(sun_irradiance(low)), 0.3 * luminance(sun_irradiance(recipe)));
    EXPECT_GT(sun_irradiance(low).x / sun_irradiance(low).z, 2 * sun_irradiance(recipe).x / sun_irradiance(recipe).z);
}

TEST(ClearSky, GroundReflectsWhatFallsOnIt) {
    ClearSkyRecipe recipe;
    recipe.ground_albedo = {1, 0.5, 0};
    const ProbeImage probe(render_clear_sky(recipe, 256), Mapping::Equirectangular);
    glm::dvec3 irradiance(0.0);
    for (int row = 0; row < 64; ++row)
        for (int column = 0; column < 256; ++column)
            irradiance += probe.solid_angle(column, row) * probe.direction(column + 0.5, row + 0.5).y *
                          glm::dvec3(probe.image().at(column, row));
    const glm::dvec3 ground = probe.radiance({0, -1, 0});
    // The sun's disc lands in whole texels, whose height differs from its own by up to half a texel, .7°.
    EXPECT_NEAR(ground.x, irradiance.x / std::numbers::pi, 0.015 * ground.x);
    EXPECT_NEAR(ground.y, 0.5 * irradiance.y / std::numbers::pi, 0.015 * ground.y);
    EXPECT_EQ(ground.z, 0);
}

TEST(ClearSky, IsFiniteLightOverItsWholeRange) {
    for (const double turbidity : {2.0, 3.5, 6.0})
        for (const double elevation : {1.0, 10.0, 90.0}) {
            ClearSkyRecipe recipe;
            recipe.turbidity = turbidity;
            recipe.sun_elevation_deg = elevation;
            const ProbeImage probe(render_clear_sky(recipe, 64), Mapping::Equirectangular);
            EXPECT_EQ(probe.report().total(), 0u) << turbidity << ", " << elevation;
            EXPECT_GT(luminance(probe.radiance({0, 1, 0})), 0);
        }
}

}  // namespace
}  // namespace rowland::lighting
