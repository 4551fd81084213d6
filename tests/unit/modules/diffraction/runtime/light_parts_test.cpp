#include "modules/diffraction/runtime/light_parts.h"

#include <gtest/gtest.h>

#include "engine/math/sh_basis.h"

namespace rowland::diffraction {
namespace {

std::shared_ptr<const lighting::LightProbe> probe_with_a_lamp() {
    lighting::LightProbe probe;
    probe.key_lights = {{.direction = {0.0, 0.0, 1.0}, .flux = {1.0, 2.0, 3.0}, .concentration = 50.0}};
    probe.sh = lighting::project(probe.key_lights, 4);
    probe.sh.coefficients[0] += glm::dvec3(5.0);
    const lighting::LightSamples lamp{
        .x = {0.0F}, .y = {0.0F}, .z = {1.0F}, .red = {1.0F}, .green = {2.0F}, .blue = {3.0F}};
    probe.light = lighting::pack(lamp, 4);
    probe.environment.layout = {.face_size = 1, .levels = 1};
    probe.environment.halves.resize(18);
    return std::make_shared<const lighting::LightProbe>(std::move(probe));
}

double green(const lighting::LightSamples& texels) {
    double sum = 0.0;
    for (const float flux : texels.green) sum += static_cast<double>(flux);
    return sum;
}

TEST(LightParts, SumToTheWholeWithKeyLightsApartOrNot) {
    const auto probe = probe_with_a_lamp();
    LightDivision division;
    render::FrameLight light{.probe = probe, .version = 1};
    EXPECT_EQ(division.of(light).sh.coefficients, probe->sh.coefficients);
    EXPECT_EQ(division.of(light).residual.coefficients, probe->sh.coefficients);
    EXPECT_TRUE(division.of(light).key_lights.empty());
    EXPECT_NEAR(green(*division.of(light).texels), 2.0, 1e-5);  // sums of floats

    light.key_lights_apart = true;
    ++light.version;
    const LightParts& parts = division.of(light);
    EXPECT_EQ(parts.sh.coefficients, probe->sh.coefficients);
    EXPECT_EQ(parts.probe_sh.coefficients, probe->sh.coefficients);
    ASSERT_EQ(parts.key_lights.size(), 1U);
    // Only the even 5 is left; sums of numbers near 1 in double.
    EXPECT_NEAR(parts.residual.coefficients[0].y, 5.0, 1e-14);
    for (std::size_t i = 1; i < 16; ++i) EXPECT_NEAR(parts.residual.coefficients[i].y, 0.0, 1e-14);
    EXPECT_NEAR(green(*parts.texels), 0.0, 1e-5);
    EXPECT_NEAR(green(*parts.probe_texels), 2.0, 1e-5);

    light.key_lights_apart = false;
    ++light.version;
    EXPECT_TRUE(division.of(light).key_lights.empty());
    EXPECT_NEAR(green(*division.of(light).texels), 2.0, 1e-5);
}

TEST(LightParts, ASunChangesTheWholeAloneAndUnpacksNothing) {
    LightDivision division;
    render::FrameLight light{.probe = probe_with_a_lamp(), .key_lights_apart = true, .version = 1};
    const LightParts before = division.of(light);
    light.distant_lights = {{{1.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}}, {{0.0F, 1.0F, 0.0F}, {0.0F, 2.0F, 0.0F}}};
    ++light.version;
    const LightParts& after = division.of(light);
    // Y_1,1 = 0.488603 x and Y_1,-1 = 0.488603 y, to six digits.
    EXPECT_NEAR(after.sh.coefficients[3].r - before.sh.coefficients[3].r, 0.488603, 1e-6);
    EXPECT_NEAR(after.sh.coefficients[1].g - before.sh.coefficients[1].g, 2.0 * 0.488603, 1e-6);
    EXPECT_NEAR(after.sh.coefficients[0].g - before.sh.coefficients[0].g, 2.0 * 0.282095, 1e-6);
    EXPECT_EQ(after.residual.coefficients, before.residual.coefficients);
    EXPECT_EQ(after.texels, before.texels);
    EXPECT_EQ(after.probe_texels, before.probe_texels);

    light.probe = probe_with_a_lamp();
    ++light.version;
    EXPECT_NE(division.of(light).texels, before.texels);
}

}  // namespace
}  // namespace rowland::diffraction
