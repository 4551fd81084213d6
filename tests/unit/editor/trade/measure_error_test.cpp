#include "editor/trade/measure_error.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "engine/colour/colour_space.h"

namespace rowland::trade {
namespace {

/// Greys, the first half 1 and the rest 0.1: dark.
std::vector<glm::dvec3> greys(double bright, double dark) {
    std::vector<glm::dvec3> xyz(10, bright * colour::white_d65());
    for (std::size_t i = 5; i < xyz.size(); ++i) xyz[i] = dark * colour::white_d65();
    return xyz;
}

TEST(MethodError, OfAMethodWithItselfIsNothing) {
    const auto xyz = greys(1.0, 0.05);
    const MethodError error = compare(xyz, xyz);
    EXPECT_EQ(error.relative_rms, 0.0);
    EXPECT_EQ(error.largest, 0.0);
    EXPECT_EQ(error.dark_absolute, 0.0);
    EXPECT_EQ(error.high_delta_e, 0.0);
}

TEST(MethodError, SeesBrightAndDarkApart) {
    const auto reference = greys(1.0, 0.05);
    const MethodError bright = compare(greys(1.1, 0.05), reference);
    // Half the points are off by a tenth: √(5·0.01/(5·1 + 5·0.0025)) = 0.0999.
    EXPECT_NEAR(bright.relative_rms, 0.0999, 1e-4);
    EXPECT_NEAR(bright.largest, 0.1, 1e-12);
    EXPECT_EQ(bright.dark_absolute, 0.0);
    const MethodError dark = compare(greys(1.0, 0.10), reference);
    // 0.05 over the mean Y, (1 + 0.05)/2.
    EXPECT_NEAR(dark.dark_absolute, 0.05 / 0.525, 1e-12);
    EXPECT_GT(dark.high_delta_e, dark.median_delta_e);
    EXPECT_GT(dark.high_delta_e, 1.0) << "twice as bright is seen";
    EXPECT_LT(dark.relative_rms, bright.relative_rms);
}

TEST(MethodError, NeutralLightIsNeutralOnTheDisplay) {
    for (const glm::vec3& pixel : displayed(greys(0.5, 0.1), 0.0F)) {
        EXPECT_NEAR(pixel.r, pixel.g, 2e-3F);  // ACES' white point, four digits
        EXPECT_NEAR(pixel.b, pixel.g, 2e-3F);
    }
}

/// A map serves the one plane it is of; on a curved surface its stand-in shades, at run time and here.
TEST(Shaded, PlanarIsItsStandInOnCurvedSurfaces) {
    const nlohmann::json material = {
        {"grating", {{"pitch_nm", 1600}, {"profile", {{"type", "slit"}, {"width_nm", 800}}}}}};
    image::Image sky{.width = 32, .height = 16, .texels = std::vector<glm::vec3>(512, glm::vec3(0.2F))};
    for (std::size_t i = 0; i < 160; ++i) sky.texels[i] = glm::vec3(1.0F, 0.8F, 0.5F);
    const diffraction::EvaluationLight light(lighting::ProbeImage(sky, lighting::Mapping::Equirectangular), 0,
                                             math::SphericalWindow::None);
    FrameSet curved = sphere_frames();
    curved.surfaces.front().resize(6);
    const auto planar = shaded(
        cook(material, "m", diffraction::parse_method("planar/map_resolution=32/bands=4/rank=8")), light, curved);
    const auto arc = shaded(cook(material, "m", diffraction::parse_method("arc/bands=4/rank=8")), light, curved);
    for (std::size_t i = 0; i < arc.size(); ++i) EXPECT_LT(glm::distance(planar[i], arc[i]), 1e-12);
    FrameSet flat = tilted_cd_frames();
    flat.surfaces.front().resize(6);
    EXPECT_NE(
        shaded(cook(material, "m", diffraction::parse_method("planar/map_resolution=32/bands=4/rank=8")), light, flat),
        shaded(cook(material, "m", diffraction::parse_method("arc/bands=4/rank=8")), light, flat));
}

std::vector<glm::dvec3> flat(double y) {
    return std::vector<glm::dvec3>(6, y * colour::white_d65());
}

/// The pixel of a panel (0, 1, 2) of 3 × 2 pixels.
glm::ivec3 pixel(const RgbPicture& picture, int panel, int column, int row, int magnified) {
    const int x = (panel * (3 + 2) + column) * magnified;
    const auto at = static_cast<std::size_t>(3 * (row * magnified * picture.width + x));
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

TEST(DifferenceImage, EqualPicturesHaveABlackDifference) {
    const RgbPicture shown = difference_image(flat(0.3), flat(0.3), 3, 2, 4);
    EXPECT_EQ(shown.width, (3 * 3 + 2 * 2) * 4);
    EXPECT_EQ(shown.height, 8);
    EXPECT_EQ(shown.rgb.size(), static_cast<std::size_t>(3 * shown.width * shown.height));
    EXPECT_EQ(pixel(shown, 0, 1, 1, 4), pixel(shown, 1, 1, 1, 4));
    EXPECT_GT(pixel(shown, 0, 1, 1, 4).g, 50);
    EXPECT_EQ(pixel(shown, 2, 1, 1, 4), glm::ivec3(0));
}

TEST(DifferenceImage, OnlyThePixelThatDiffersIsLit) {
    std::vector<glm::dvec3> other = flat(0.3);
    other[4] *= 20.0;
    const RgbPicture shown = difference_image(other, flat(0.3), 3, 2, 1);
    EXPECT_GT(pixel(shown, 0, 1, 1, 1).g, pixel(shown, 1, 1, 1, 1).g);
    EXPECT_GT(pixel(shown, 2, 1, 1, 1).r, 200) << "far beyond the end of the scale: yellow";
    EXPECT_EQ(pixel(shown, 2, 0, 0, 1), glm::ivec3(0));
}

TEST(DifferenceImage, TheScaleGrowsLighter) {
    double last = -1.0;
    for (int i = 0; i <= 20; ++i) {
        const glm::vec3 c = difference_colour(i / 20.0);
        const double luma =
            0.2126 * static_cast<double>(c.r) + 0.7152 * static_cast<double>(c.g) + 0.0722 * static_cast<double>(c.b);
        EXPECT_GT(luma, last) << i;
        last = luma;
    }
    EXPECT_EQ(difference_colour(3.0), difference_colour(1.0));
}

}  // namespace
}  // namespace rowland::trade
