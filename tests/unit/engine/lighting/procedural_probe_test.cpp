#include <gtest/gtest.h>

#include "engine/lighting/procedural_probe.h"
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

SoftBox box_at(double azimuth_deg, double elevation_deg) {
    SoftBox box;
    box.azimuth_deg = azimuth_deg;
    box.elevation_deg = elevation_deg;
    box.half_width_deg = 10;
    box.half_height_deg = 20;
    box.radiance = {3, 2, 1};
    return box;
}

double lit_solid_angle(const ProbeImage& probe) {
    double sum = 0;
    for (int row = 0; row < probe.image().height; ++row)
        for (int column = 0; column < probe.image().width; ++column)
            sum += probe.solid_angle(column, row) * probe.image().at(column, row).y / 2;
    return sum;
}

TEST(Studio, BoxesAreWhereTheirAnglesSay) {
    StudioRecipe recipe;
    recipe.boxes = {box_at(90, 0), box_at(0, 60)};
    const ProbeImage probe(render_studio(recipe, 256), Mapping::Equirectangular);
    EXPECT_EQ(probe.radiance({1, 0, 0}), glm::dvec3(3, 2, 1));
    EXPECT_EQ(probe.radiance(glm::normalize(glm::dvec3(0, std::sqrt(3.0), -1))), glm::dvec3(3, 2, 1));
    EXPECT_EQ(probe.radiance({0, 0, 1}), glm::dvec3(0.0));
    EXPECT_EQ(probe.radiance({0, 0, -1}), glm::dvec3(0.0));
    // Of the first box, 10° to each side and 20° up and down.
    const auto at = [&](double azimuth_deg, double elevation_deg) {
        const double a = glm::radians(azimuth_deg);
        const double e = glm::radians(elevation_deg);
        return probe.radiance({std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)}).x;
    };
    EXPECT_EQ(at(98, 0), 3);
    EXPECT_EQ(at(102, 0), 0);
    EXPECT_EQ(at(90, 18), 3);
    EXPECT_EQ(at(90, 22), 0);
}

TEST(Studio, BoxKeepsItsSolidAngleWhereverItHangs) {
    // A rectangle at distance 1 with half sides a = tan 10°, b = tan 20°: 4 asin(ab / √((1+a²)(1+b²))) steradians.
    const double exact = 4 * std::asin(std::sin(glm::radians(10.0)) * std::sin(glm::radians(20.0)));
    for (const double elevation : {0.0, 45.0, 80.0, -60.0}) {
        StudioRecipe recipe;
        recipe.boxes = {box_at(-130, elevation)};
        recipe.boxes[0].roll_deg = 33;
        const ProbeImage probe(render_studio(recipe, 512), Mapping::Equirectangular);
        EXPECT_NEAR(lit_solid_angle(probe) / exact, 1, 0.005) << elevation;  // 4 × 4 samples per texel of .7°
    }
}

TEST(Studio, RollTurnsCounterClockwise) {
    StudioRecipe recipe;
    recipe.boxes = {box_at(0, 0)};
    recipe.boxes[0].roll_deg = 45;
    const ProbeImage probe(render_studio(recipe, 512), Mapping::Equirectangular);
    // Its long side, upright before, now leans to the upper left.
    EXPECT_EQ(probe.radiance(glm::normalize(glm::dvec3(-0.18, 0.18, -1))).x, 3);
    EXPECT_EQ(probe.radiance(glm::normalize(glm::dvec3(0.18, 0.18, -1))).x, 0);
}

TEST(Studio, SoftEdgesFallInsideTheBox) {
    StudioRecipe recipe;
    recipe.boxes = {box_at(0, 0)};
    const double hard = lit_solid_angle({render_studio(recipe, 256), Mapping::Equirectangular});
    recipe.boxes[0].soft_edge_deg = 5;
    const ProbeImage soft(render_studio(recipe, 256), Mapping::Equirectangular);
    EXPECT_LT(lit_solid_angle(soft), 0.8 * hard);  // half of 5° is lost at each of 20° and 40°: (15·35)/(20·40) = .66
    EXPECT_GT(lit_solid_angle(soft), 0.6 * hard);
    EXPECT_EQ(soft.radiance({0, 0, -1}).x, 3);
}

TEST(Studio, RoomBlendsFromFloorOverWallsToCeiling) {
    StudioRecipe recipe;
    recipe.ceiling = glm::dvec3(4.0);
    recipe.wall = glm::dvec3(2.0);
    recipe.floor = glm::dvec3(1.0);
    const ProbeImage probe(render_studio(recipe, 256), Mapping::Equirectangular);
    EXPECT_NEAR(probe.radiance({0, 1, 0}).x, 4, 0.02);
    EXPECT_NEAR(probe.radiance({0, 0, -1}).x, 2, 0.02);
    EXPECT_NEAR(probe.radiance({0, -1, 0}).x, 1, 0.02);
    EXPECT_NEAR(probe.radiance(glm::normalize(glm::dvec3(1, 1, 0))).x, 3, 0.02);
}

}  // namespace

}  // namespace rowland::lighting
