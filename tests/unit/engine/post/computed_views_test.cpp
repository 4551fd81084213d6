#include "engine/post/computed_views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "engine/colour/srgb.h"
#include "engine/colour/working_space.h"
#include "engine/post/agx.h"
#include "engine/post/display_transform.h"
#include "engine/post/false_colour.h"
#include "engine/post/working_space.h"

namespace rowland::post {

namespace {

/// What a view shows for linear Rec.709 light.
glm::dvec3 shown_by(const char* view, const glm::dvec3& rgb) {
    const OcioConfig config = OcioConfig::shipped();
    const DisplayTransform transform(config, {"", view});
    glm::vec3 pixel(xyz_to_scene_linear(config) * colour::rec709_to_xyz() * rgb);
    transform.apply_cpu({&pixel, 1});
    return pixel;
}

/// Against the polynomial of degree 6 that Wrensch 2023 (Minimal AgX Implementation) fits to the same curve; its fit is
/// good to about 0.01.
TEST(ComputedViews, AgxCurveIsThePublishedOne) {
    for (double x = 0.0; x <= 1.0; x += 0.05) {
        const double fit = ((((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x) - 0.00232;
        EXPECT_NEAR(agx_curve(x), fit, 0.012) << x;
    }
    EXPECT_NEAR(agx_curve(0.0), 0.0, 1e-9);
    EXPECT_NEAR(agx_curve(1.0), 1.0, 1e-9);
}

TEST(ComputedViews, AgxMixesWithinTheInsetThenAppliesTheCurve) {
    for (const glm::dvec3& rgb : {glm::dvec3(0.18), glm::dvec3(0.7, 0.3, 0.12), glm::dvec3(6.0, 5.0, 4.0)}) {
        glm::dvec3 value = agx_inset() * rgb;
        for (int c = 0; c < 3; ++c)
            value[c] = agx_curve((std::log2(value[c]) - agx_least_stop) / (agx_most_stop - agx_least_stop));
        value = glm::inverse(agx_inset()) * value;
        const glm::dvec3 shown = shown_by("AgX", rgb);
        // OpenColorIO's fast powers are good to 1e-4, its two matrices of Rec.709 agree to about the same.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], colour::srgb_encoded(std::pow(value[c], agx_gamma)), 1e-3);
    }
}

TEST(ComputedViews, FalseColourHasOneColourForEachStop) {
    for (const double stops : {-9.0, -4.2, -0.3, 0.0, 0.4, 1.0, 3.3, 8.0}) {
        const glm::dvec3 expected = false_colour(stops);
        // Of any hue: luminance alone counts.
        const double luminance = 0.18 * std::exp2(stops);
        for (const glm::dvec3& rgb : {glm::dvec3(luminance), luminance * glm::dvec3(1.0, 0.0, 0.0) / 0.2126}) {
            const glm::dvec3 shown = shown_by("False Colour", rgb);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], colour::srgb_encoded(expected[c]), 2e-3) << stops;
        }
    }
    EXPECT_NE(false_colour(0.6), false_colour(0.4));
}

TEST(ComputedViews, HdrShowsGreyAs15Candelas) {
    const OcioConfig config = OcioConfig::shipped();
    const DisplayTransform pq(config, {"Rec.2100-PQ - Display", "ACES 1.1 - HDR Video"});
    glm::vec3 grey(0.18F);
    pq.apply_cpu({&grey, 1});
    // ACES shows 0.18 as 15 cd/m²; PQ of that by ST 2084.
    const double power = std::pow(15.0 / 10000.0, 0.1593017578125);
    const double expected = std::pow((0.8359375 + 18.8515625 * power) / (1.0 + 18.6875 * power), 78.84375);
    EXPECT_NEAR(grey.g, expected, 5e-3);
}

}  // namespace

}  // namespace rowland::post
