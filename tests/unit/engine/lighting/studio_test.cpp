#include "engine/lighting/studio.h"

#include <gtest/gtest.h>

#include "engine/lighting/probe_image.h"
#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {
namespace {

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
