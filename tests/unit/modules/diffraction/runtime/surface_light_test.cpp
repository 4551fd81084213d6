#include <gtest/gtest.h>
#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/runtime/surface_light.h"

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

/// Even light of radiance SH 5, and two lamps that are its key lights.
std::shared_ptr<const lighting::LightProbe> probe_with_lamps() {
    lighting::LightProbe probe;
    probe.key_lights = {{.direction = {0.0, 0.0, 1.0}, .flux = {1.0, 2.0, 3.0}, .concentration = 50.0},
                        {.direction = {1.0, 0.0, 0.0}, .flux = {2.0, 4.0, 6.0}, .concentration = 200.0}};
    probe.sh = lighting::project(probe.key_lights, 4);
    probe.sh.coefficients[0] += glm::dvec3(5.0);
    probe.light = lighting::pack(lighting::LightSamples{.x = {0.0F, 1.0F},
                                                        .y = {0.0F, 0.0F},
                                                        .z = {1.0F, 0.0F},
                                                        .red = {1.0F, 2.0F},
                                                        .green = {2.0F, 4.0F},
                                                        .blue = {3.0F, 6.0F}},
                                 4);
    return std::make_shared<const lighting::LightProbe>(std::move(probe));
}

double green(const lighting::LightSamples& samples) {
    return std::accumulate(samples.green.begin(), samples.green.end(), 0.0);
}

TEST(SurfaceLight, WithoutAnalyticKeyLightsTheProbeIsWhole) {
    const render::FrameLight frame{.probe = probe_with_lamps(), .version = 1};
    SurfaceLight light(math::SphericalWindow::None);
    light.set(frame);
    EXPECT_TRUE(light.key_lights(64).empty());
    EXPECT_EQ(light.whole_harmonics(4).coefficients, frame.probe->sh.coefficients);
    EXPECT_EQ(light.probe_harmonics(4, 64).coefficients, frame.probe->sh.coefficients);
    EXPECT_NEAR(green(*light.probe_samples(64)), 6.0, 1e-5);  // sums of floats
    EXPECT_EQ(light.illuminant(), frame.probe->illuminant.name);
}

TEST(SurfaceLight, TheProbeIsWithoutTheFirstKeyLightsAlone) {
    render::FrameLight frame{.probe = probe_with_lamps(), .analytic_key_lights = true, .version = 1};
    SurfaceLight light(math::SphericalWindow::None);
    light.set(frame);
    EXPECT_EQ(light.whole_harmonics(4).coefficients, frame.probe->sh.coefficients);
    double analytic = 0.0;
    for (const int most : {0, 1, 2, 64}) {
        const std::span<const lighting::KeyLight> keys = light.key_lights(most);
        ASSERT_EQ(keys.size(), static_cast<std::size_t>(std::min(most, 2)));
        if (most == 1 || most == 2) analytic += keys.back().flux.g;
        EXPECT_NEAR(green(*light.probe_samples(most)), 6.0 - analytic, 1e-5) << most;
        const lighting::ShLight rest = lighting::residual(frame.probe->sh, keys, 4);
        for (std::size_t i = 0; i < 16; ++i)
            EXPECT_EQ(light.probe_harmonics(4, most).coefficients[i], rest.coefficients[i]) << most;
    }
    // Only the even 5 is left; sums of numbers near 1 in double.
    EXPECT_NEAR(light.probe_harmonics(4, 2).coefficients[0].y, 5.0, 1e-14);

    frame.analytic_key_lights = false;
    ++frame.version;
    light.set(frame);
    EXPECT_TRUE(light.key_lights(64).empty());
    EXPECT_NEAR(green(*light.probe_samples(64)), 6.0, 1e-5);
}

TEST(SurfaceLight, ASunChangesTheWholeAloneAndUnpacksNothing) {
    render::FrameLight frame{.probe = probe_with_lamps(), .analytic_key_lights = true, .version = 1};
    SurfaceLight light(math::SphericalWindow::None);
    light.set(frame);
    const lighting::ShLight before = light.whole_harmonics(4);
    const lighting::ShLight rest = light.probe_harmonics(4, 2);
    const auto whole_samples = light.probe_samples(0);
    const auto samples = light.probe_samples(2);
    frame.distant_lights = {{{1.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}}, {{0.0F, 1.0F, 0.0F}, {0.0F, 2.0F, 0.0F}}};
    ++frame.version;
    light.set(frame);
    // Y_1,1 = 0.488603 x and Y_1,-1 = 0.488603 y, to six digits.
    const lighting::ShLight& after = light.whole_harmonics(4);
    EXPECT_NEAR(after.coefficients[3].r - before.coefficients[3].r, 0.488603, 1e-6);
    EXPECT_NEAR(after.coefficients[1].g - before.coefficients[1].g, 2.0 * 0.488603, 1e-6);
    EXPECT_NEAR(after.coefficients[0].g - before.coefficients[0].g, 2.0 * 0.282095, 1e-6);
    EXPECT_EQ(light.probe_harmonics(4, 2).coefficients, rest.coefficients);
    EXPECT_EQ(light.probe_samples(0), whole_samples);
    EXPECT_EQ(light.probe_samples(2), samples);

    frame.probe = probe_with_lamps();
    ++frame.version;
    light.set(frame);
    EXPECT_NE(light.probe_samples(2), samples);
}

/// The window is chosen for the light that is left, not for the one before.
TEST(SurfaceLight, AMovedSunIsWindowedAnew) {
    render::FrameLight frame{.probe = probe_with_lamps(), .version = 1};
    SurfaceLight light(std::nullopt);
    for (const glm::vec3 direction : {glm::vec3(0.0F), glm::vec3(0.0F, 1.0F, 0.0F), glm::vec3(0.0F, 0.0F, -1.0F)}) {
        frame.distant_lights = {{direction, glm::vec3(50.0F * glm::length(direction))}};
        ++frame.version;
        light.set(frame);
        lighting::ShLight expected = frame.probe->sh;
        std::vector<double> basis(expected.coefficients.size());
        math::evaluate_sh(glm::dvec3(direction), 4, basis);
        for (std::size_t i = 0; i < basis.size() && frame.version > 2; ++i)
            expected.coefficients[i] += glm::dvec3(50.0 * basis[i]);
        const math::SphericalWindow window = weakest_window(expected, 4);
        EXPECT_EQ(window == math::SphericalWindow::None, frame.version == 2) << "a sun alone rings";
        EXPECT_EQ(light.whole_harmonics(4).coefficients, lighting::limit_bands(expected, 4, window).coefficients);
    }
}

}  // namespace
}  // namespace rowland::diffraction
