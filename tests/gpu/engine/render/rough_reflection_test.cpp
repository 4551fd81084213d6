// What a rough surface reflects of a probe, against the sum over the lobe on the CPU.
#include <glm/geometric.hpp>

#include "engine/lighting/light_samples.h"
#include "tests/gpu/render_test.h"

namespace rowland::render {
namespace {

class RoughReflection : public test::RenderTest {
 protected:
    /// Radiance 1 + .9 x.
    static lighting::ProbeImage brighter_along_x() {
        constexpr int kHeight = 64;
        image::Image image = image::make_image(2 * kHeight, kHeight);
        const lighting::ProbeImage black(image, lighting::Mapping::Equirectangular);
        for (int row = 0; row < kHeight; ++row)
            for (int column = 0; column < 2 * kHeight; ++column)
                image.at(column, row) =
                    glm::vec3(static_cast<float>(1.0 + 0.9 * black.direction(column + 0.5, row + 0.5).x));
        return {image, lighting::Mapping::Equirectangular};
    }
};

TEST_F(RoughReflection, SeesTheLightOfTheWholeLobeAndNotOnlyAroundTheMirrorsDirection) {
    const lighting::ProbeImage image = brighter_along_x();
    lighting::LightProbeSettings settings;
    settings.bands = 3;
    settings.key_lights = 0;
    settings.light_face = 16;
    settings.prefilter.face_size = 32;
    renderer_.set_probe(lighting::build_light_probe(image, settings));
    const lighting::LightSamples light = lighting::light_samples(image, {}, 0.05);
    camera_.eye = {2.5F, 0.0F, 1.5F};
    const glm::dvec3 v = glm::normalize(glm::dvec3(camera_.eye));
    const glm::dvec3 n(0.0, 0.0, 1.0);
    for (const double roughness : {0.4, 0.6, 0.8, 1.0}) {
        const ecs::Entity metal = add(
            square(), {.base_colour = glm::vec3(1.0F), .metallic = 1.0F, .roughness = static_cast<float>(roughness)});
        double expected = 0.0;
        for (std::size_t i = 0; i < light.size(); ++i)
            expected += test::reflected(light.direction(i), n, v, glm::dvec3(1.0), 1.0, roughness).x * light.flux(i).x;
        // Of a mean radiance of 1: the largest of the four is off by .092, with the mirror's direction by .24
        // (measured).
        EXPECT_NEAR(draw()[kSize / 2 * kSize + kSize / 2].x, expected, 0.1) << roughness;
        world_.destroy(metal);
    }
}

}  // namespace
}  // namespace rowland::render
