#include "modules/diffraction/runtime/surface_light.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "engine/lighting/light_probe.h"
#include "tests/gpu/modules/diffraction/grating_light.h"
#include "tests/gpu/render_test.h"

namespace rowland::diffraction {
namespace {

class SurfaceLightParts : public rowland::test::RenderTest {};

double red(const lighting::LightSamples& texels) {
    double sum = 0.0;
    for (const float flux : texels.red) sum += static_cast<double>(flux);
    return sum;
}

/// What is not shaded light by light is in the rest: as SH, and as texels, which are unpacked once for a probe.
TEST_F(SurfaceLightParts, FewerKeyLightsLeaveTheOthersInTheRest) {
    auto probe = std::make_shared<lighting::LightProbe>(lighting::build_light_probe(
        smooth_probe(), {.bands = 4, .key_lights = 0, .light_face = 16, .prefilter = {.face_size = 16}}));
    probe->key_lights = three_keys();
    render::FrameLight frame{.probe = probe, .key_lights_apart = true, .version = 1};
    LightDivision division;
    SurfaceLight light(math::SphericalWindow::None);
    light.set(division.of(frame));
    EXPECT_EQ(light.key_lights(0).size(), 0U);
    EXPECT_EQ(light.key_lights(2).size(), 2U);
    EXPECT_EQ(light.key_lights(64).size(), 3U);
    const double whole = red(*light.texels({LightPart::Probe}));
    double apart = 0.0;
    for (const int count : {0, 1, 2, 3, 64}) {
        const std::span<const lighting::KeyLight> keys = light.key_lights(count);
        if (!keys.empty() && count <= 3) apart += keys.back().flux.r;
        // Sums of some 1e5 floats.
        EXPECT_NEAR(red(*light.texels({LightPart::Rest, count})), whole - apart, 1e-3) << count;
        EXPECT_EQ(light.harmonics(4, {LightPart::Rest, count}).coefficients,
                  lighting::residual(probe->sh, keys, 4).coefficients)
            << count;
    }
    const auto of_two = light.texels({LightPart::Rest, 2});
    frame.distant_lights = {{{1.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}}};
    ++frame.version;
    light.set(division.of(frame));
    EXPECT_EQ(light.texels({LightPart::Rest, 2}), of_two) << "a sun changes no map";
    frame.probe = std::make_shared<const lighting::LightProbe>(*probe);
    ++frame.version;
    light.set(division.of(frame));
    EXPECT_NE(light.texels({LightPart::Rest, 2}), of_two);
}

}  // namespace
}  // namespace rowland::diffraction
