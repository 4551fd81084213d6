#include "engine/render/probe_light.h"

#include <gtest/gtest.h>

#include <array>

namespace rowland::render {
namespace {

lighting::LightProbe probe_with_a_lamp() {
    lighting::LightProbe probe;
    probe.key_lights = {{.direction = {0.0, 0.0, 1.0}, .flux = {1.0, 2.0, 3.0}, .concentration = 50.0}};
    probe.sh = lighting::project(probe.key_lights, 4);
    probe.sh.coefficients[0] += glm::dvec3(5.0);
    probe.ambient = lighting::ambient_coefficients(probe.sh);
    return probe;
}

TEST(ProbeLight, IsWholeOrDividedAndSumsToTheSame) {
    const lighting::LightProbe probe = probe_with_a_lamp();
    ProbeLight light(probe);
    light.divide(false);
    EXPECT_EQ(light.sh().coefficients, probe.sh.coefficients);
    EXPECT_EQ(light.residual().coefficients, probe.sh.coefficients);
    EXPECT_TRUE(light.key_lights().empty());
    EXPECT_EQ(light.ambient(), probe.ambient.coefficients);

    light.divide(true);
    EXPECT_EQ(light.sh().coefficients, probe.sh.coefficients);
    ASSERT_EQ(light.key_lights().size(), 1U);
    // Only the even 5 is left; sums of numbers near 1 in double.
    EXPECT_NEAR(light.residual().coefficients[0].y, 5.0, 1e-14);
    for (std::size_t i = 1; i < 16; ++i) EXPECT_NEAR(light.residual().coefficients[i].y, 0.0, 1e-14);
    EXPECT_NEAR(light.ambient()[0].y, 5.0, 1e-14);
    EXPECT_NEAR(light.ambient()[2].y, 0.0, 1e-14);

    light.divide(false);
    EXPECT_TRUE(light.key_lights().empty());
    EXPECT_EQ(light.ambient(), probe.ambient.coefficients);
}

TEST(ProbeLight, TexelsAreLessTheKeyLightsJustWhenThoseAreApart) {
    lighting::LightProbe probe = probe_with_a_lamp();
    const lighting::LightTexels lamp{
        .x = {0.0F}, .y = {0.0F}, .z = {1.0F}, .red = {1.0F}, .green = {2.0F}, .blue = {3.0F}};
    probe.light = lighting::pack(lamp, 4);
    ProbeLight light(probe);
    const auto green = [&](bool with_keys) {
        light.divide(with_keys);
        double sum = 0.0;
        for (const float flux : light.texels()->green) sum += flux;
        return sum;
    };
    EXPECT_NEAR(green(false), 2.0, 1e-5);  // sums of floats
    EXPECT_NEAR(green(true), 0.0, 1e-5);
    EXPECT_NEAR(green(false), 2.0, 1e-5);
}

}  // namespace
}  // namespace rowland::render
