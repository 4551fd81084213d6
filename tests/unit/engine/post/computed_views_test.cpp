#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "engine/colour/colour_space.h"
#include "engine/colour/spectrum.h"
#include "engine/post/computed_views.h"
#include "engine/post/display_pass.h"
#include "engine/post/ocio_config.h"

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

glm::dvec3 oklab_of_rec709(const glm::dvec3& rgb) {
    return colour::oklab_of_lms(colour::rec709_to_oklab_lms() * rgb);
}

/// Calls with Oklab of a light of one wavelength in the scene, and of what a view of the shipped configuration shows
/// for it, at luminances from 6 stops below 0.18 to where `below_white` ends.
void for_each_light_of_a_spectrum(const DisplayTransform& view, double most_lightness,
                                  const std::function<void(double, double, glm::dvec3, glm::dvec3)>& check) {
    const glm::dmat3 to_working = xyz_to_scene_linear(OcioConfig::shipped());
    const glm::dmat3 to_rec709 = glm::inverse(colour::rec709_to_xyz());
    for (int wavelength_nm = 440; wavelength_nm <= 650; wavelength_nm += 5) {
        const glm::dvec3 xyz = colour::cie_xyz(wavelength_nm);
        for (double stops = -6.0; stops <= 8.0; stops += 0.5) {
            const glm::dvec3 light = xyz / xyz.y * 0.18 * std::exp2(stops);
            glm::vec3 pixel(to_working * light);
            view.apply_cpu({&pixel, 1});
            const glm::dvec3 shown = oklab_of_rec709(
                {colour::srgb_linear(pixel.r), colour::srgb_linear(pixel.g), colour::srgb_linear(pixel.b)});
            if (shown.x > most_lightness) break;
            check(wavelength_nm, stops, oklab_of_rec709(to_rec709 * light), shown);
        }
    }
}

/// The default view. Its table is what differs from constant_hue(), which keeps hues exactly.
TEST(ConstantHue, DefaultViewKeepsTheHueOfSpectralLight) {
    const DisplayTransform view(OcioConfig::shipped());
    // Above a lightness of 0.97 there is no chroma to see a hue of.
    for_each_light_of_a_spectrum(view, 0.97,
                                 [&](double wavelength_nm, double stops, glm::dvec3 light, glm::dvec3 shown) {
                                     const double shift = colour::oklab_hue_difference_deg(light, shown);
                                     EXPECT_LE(shift, 5.0) << wavelength_nm << " nm, " << stops << " stops";
                                 });
}

TEST(ConstantHue, AcesViewShiftsTheHueOfSpectralLight) {
    const DisplayTransform view(OcioConfig::shipped(), {"", "ACES 1.0 - SDR Video"});
    double worst = 0.0;
    for_each_light_of_a_spectrum(view, 0.97, [&](double, double, glm::dvec3 light, glm::dvec3 shown) {
        worst = std::max(worst, colour::oklab_hue_difference_deg(light, shown));
    });
    EXPECT_GT(worst, 30.0);
}

TEST(ConstantHue, SpectralLightGetsBrighterUpToWhiteAndStaysColouredBefore) {
    const DisplayTransform view(OcioConfig::shipped());
    double last_stops = 0.0;
    double last_lightness = 0.0;
    for_each_light_of_a_spectrum(view, 1.0, [&](double wavelength_nm, double stops, glm::dvec3, glm::dvec3 shown) {
        if (stops > last_stops && last_lightness < 0.999) {
            EXPECT_GT(shown.x, last_lightness) << wavelength_nm << " nm, " << stops;
        }
        if (stops == 0.0) {
            EXPECT_GT(glm::length(glm::dvec2(shown.y, shown.z)), 0.07) << wavelength_nm;
        }
        if (stops == 8.0) {
            EXPECT_LT(glm::length(glm::dvec2(shown.y, shown.z)), 0.03) << wavelength_nm;
        }
        last_stops = stops;
        last_lightness = shown.x;
    });
}

TEST(ConstantHue, NoChannelIsClippedBeforeWhite) {
    const DisplayTransform view(OcioConfig::shipped());
    std::mt19937 random(7);
    std::uniform_real_distribution<float> component(0.0F, 2.0F);
    for (int i = 0; i < 2000; ++i) {
        const float r = component(random);
        const float g = component(random);
        glm::vec3 pixel(r, g, component(random));
        if (std::max({pixel.r, pixel.g, pixel.b}) < 0.1F) continue;
        view.apply_cpu({&pixel, 1});
        EXPECT_GT(std::min({pixel.r, pixel.g, pixel.b}), 0.0F);
        EXPECT_LT(std::max({pixel.r, pixel.g, pixel.b}), 1.0F);
    }
}

/// Between its entries the table is off by less than a step of 8 bits in the mean, and most at the edges of the gamut;
/// black is black.
TEST(ConstantHue, TableOfTheViewIsTheFormula) {
    const DisplayTransform view(OcioConfig::shipped());
    const glm::dmat3 to_working = xyz_to_scene_linear(OcioConfig::shipped()) * colour::rec709_to_xyz();
    std::mt19937 random(11);
    std::uniform_real_distribution<double> stop(-8.0, 5.0);
    double worst = 0.0;
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < 2000; ++i) {
        const double r = std::exp2(stop(random));
        const double g = std::exp2(stop(random));
        const glm::dvec3 rgb(r, g, std::exp2(stop(random)));
        glm::vec3 pixel(to_working * rgb);
        view.apply_cpu({&pixel, 1});
        const glm::dvec3 exact = constant_hue(colour::rec709_to_oklab_lms() * rgb);
        for (int c = 0; c < 3; ++c) {
            const double off = std::abs(pixel[c] - colour::srgb_encoded(exact[c]));
            worst = std::max(worst, off);
            sum += off;
            ++count;
        }
    }
    EXPECT_LE(worst, 0.06);
    EXPECT_LE(sum / count, 0.004);
    glm::vec3 black(0.0F);
    view.apply_cpu({&black, 1});
    EXPECT_NEAR(black.g, 0.0F, 1e-3F);
}

TEST(ConstantHue, NeutralsFollowTheToneCurve) {
    EXPECT_NEAR(constant_hue_tone(0.18), 0.1041, 1e-4);
    EXPECT_NEAR(constant_hue_tone(1.0), 0.6243, 1e-4);
    for (const double light : {0.01, 0.18, 1.0, 30.0}) {
        const glm::dvec3 shown = constant_hue(glm::dvec3(light));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], constant_hue_tone(light), 1e-4);
    }
}

}  // namespace

}  // namespace rowland::post
