// Directional, point and spot lights against the formula on the CPU.
#include <glm/gtc/matrix_transform.hpp>

#include "tests/gpu/render_test.h"

namespace rowland::render {
namespace {

class LightsTest : public test::RenderTest {
 protected:
    LightsTest() { add(square(), {.base_colour = kBase, .metallic = 0.25F, .roughness = 0.6F}); }
    void add_directional(const glm::vec3& toward, const glm::vec3& irradiance) {
        world_.add(world_.create(),
                   scene::DirectionalLight{.direction = glm::normalize(toward), .irradiance = irradiance});
    }
    ecs::Entity add_punctual(const scene::PunctualLight& light, const glm::mat4& matrix) {
        const ecs::Entity entity = world_.create();
        world_.add(entity, scene::PunctualLight(light));
        world_.add(entity, scene::WorldMatrix{matrix});
        return entity;
    }
    /// The factor on `intensity`/distance²: glTF's range window max(0, 1 − (distance/range)⁴) times a spot's cone
    /// (KHR_lights_punctual). `cos_axis`: cosine between the axis and the direction to the point.
    static float attenuation(const scene::PunctualLight& light, float distance_m, float cos_axis) {
        const float window =
            light.range_m > 0.0F ? std::max(0.0F, 1.0F - std::pow(distance_m / light.range_m, 4.0F)) : 1.0F;
        if (!light.spot) return window;
        // The lower bound is that of the extension's reference code.
        const float cos_inner = std::cos(light.inner_cone);
        const float cos_outer = std::cos(light.outer_cone);
        const float cone = std::clamp((cos_axis - cos_outer) / std::max(0.001F, cos_inner - cos_outer), 0.0F, 1.0F);
        return window * cone * cone;
    }
    /// Radiance of a position on the square under unit irradiance from a direction.
    static glm::dvec3 reflected(const glm::vec3& position, const glm::dvec3& toward) {
        const glm::dvec3 v = glm::normalize(glm::dvec3(0.0, 0.0, kEye) - glm::dvec3(position));
        return test::reflected(glm::normalize(toward), {0.0, 0.0, 1.0}, v, glm::dvec3(kBase), 0.25, 0.6);
    }
    /// The same under a light at a point that shines along `axis`.
    static glm::dvec3 reflected(const glm::vec3& position, const scene::PunctualLight& light, const glm::vec3& from,
                                const glm::vec3& axis) {
        const glm::vec3 to_light = from - position;
        const float distance = glm::length(to_light);
        const float cosine = -glm::dot(axis, to_light) / distance;
        const double reaches = attenuation(light, distance, cosine) / (distance * distance);
        return reflected(position, glm::dvec3(to_light)) * reaches * glm::dvec3(light.intensity);
    }
    /// Floats through a dozen operations, and GGX's peak.
    static void expect_equal(const glm::vec4& drawn, const glm::dvec3& expected) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(drawn[c], expected[c], 1e-6 + 3e-5 * expected[c]);
    }
    static constexpr glm::vec3 kBase{0.5F, 0.3F, 0.1F};
};

/// A disc's reflection in a glossy metal against the mean over its points, across the highlight.
TEST_F(LightsTest, ADiscsHighlightIsTheMeanOfItsPoints) {
    world_ = {};
    add(square(), {.base_colour = glm::vec3(1.0F), .metallic = 1.0F, .roughness = 0.2F});
    const glm::dvec3 toward = glm::normalize(glm::dvec3(0.1, 0.0, 1.0));
    const double radius = 0.1;
    world_.add(world_.create(), scene::DirectionalLight{.direction = glm::vec3(toward),
                                                        .irradiance = glm::vec3(1.0F),
                                                        .angular_radius = static_cast<float>(radius)});
    const auto pixels = draw();
    const auto expected = [&](const glm::vec3& position) {
        const glm::dvec3 v = glm::normalize(glm::dvec3(0.0, 0.0, kEye) - glm::dvec3(position));
        const glm::dvec3 across = glm::normalize(glm::cross(toward, glm::dvec3(0.0, 1.0, 0.0)));
        constexpr int kPoints = 400;
        double sum = 0.0;
        for (int i = 0; i < kPoints; ++i) {  // a sunflower's seeds
            const double r = std::sin(radius) * std::sqrt((i + 0.5) / kPoints);
            const double angle = 2.399963229728653 * i;
            const glm::dvec3 offset = r * (std::cos(angle) * across + std::sin(angle) * glm::cross(toward, across));
            const glm::dvec3 l = toward * std::sqrt(1.0 - r * r) + offset;
            sum += test::reflected(l, {0.0, 0.0, 1.0}, v, glm::dvec3(1.0), 1.0, 0.2).x;
        }
        return sum / kPoints;
    };
    double brightest = 0.0;
    double largest = 0.0;
    for (float x = -0.3F; x < 0.8F; x += 0.05F) {
        const double value = expected(position_of(x, 0.02F));
        brightest = std::max(brightest, value);
        largest = std::max(largest, std::abs(static_cast<double>(at(pixels, x, 0.02F).r) - value));
    }
    EXPECT_LT(largest, 0.2 * brightest);  // measured: .16, at the rim
}

TEST_F(LightsTest, TwoDirectionalLightsAdd) {
    add_directional({1.0F, 0.2F, 0.7F}, {1.0F, 2.0F, 0.5F});
    add_directional({-0.5F, 0.6F, 0.4F}, {3.0F, 0.25F, 1.0F});
    const glm::vec3 position = position_of(0.3F, -0.5F);
    expect_equal(at(draw(), 0.3F, -0.5F), reflected(position, {1.0, 0.2, 0.7}) * glm::dvec3(1.0, 2.0, 0.5) +
                                              reflected(position, {-0.5, 0.6, 0.4}) * glm::dvec3(3.0, 0.25, 1.0));
}

TEST_F(LightsTest, PointLightFallsWithTheSquareOfTheDistanceUpToItsRange) {
    const glm::vec3 from(0.4F, -0.2F, 0.7F);
    for (const float range : {0.0F, 1.2F}) {  // the last point lies beyond
        const scene::PunctualLight light{.intensity = {2.0F, 1.0F, 0.5F}, .range_m = range};
        const ecs::Entity entity = add_punctual(light, glm::translate(glm::mat4(1.0F), from));
        const auto pixels = draw();
        for (const glm::vec2 p : {glm::vec2(0.4F, -0.2F), glm::vec2(-0.6F, 0.5F), glm::vec2(0.9F, 0.9F)})
            expect_equal(at(pixels, p.x, p.y), reflected(position_of(p.x, p.y), light, from, {0.0F, 0.0F, -1.0F}));
        world_.destroy(entity);
    }
}

TEST_F(LightsTest, SpotShinesAlongItsMinusZWithinItsCone) {
    const scene::PunctualLight light{
        .intensity = glm::vec3(2.0F), .spot = true, .inner_cone = 0.2F, .outer_cone = 0.5F};
    // Moved aside and tilted: its axis meets the plane at (-0.3, 0.1).
    const glm::vec3 from(0.2F, 0.1F, 1.4F);
    const glm::vec3 target(-0.3F, 0.1F, 0.0F);
    add_punctual(light, glm::inverse(glm::lookAt(from, target, {0.0F, 1.0F, 0.0F})));
    const auto pixels = draw();
    int dark = 0;
    int partly = 0;
    for (float x = -0.95F; x < 1.0F; x += 0.0727F) {
        const glm::vec3 position = position_of(x, 0.0F);
        const glm::dvec3 expected = reflected(position, light, from, glm::normalize(target - from));
        expect_equal(at(pixels, x, 0.0F), expected);
        const float angle = std::acos(glm::dot(glm::normalize(position - from), glm::normalize(target - from)));
        dark += angle > light.outer_cone ? 1 : 0;
        partly += angle > light.inner_cone && angle < light.outer_cone ? 1 : 0;
        if (angle <= light.outer_cone) continue;
        EXPECT_EQ(at(pixels, x, 0.0F).g, 0.0F);
    }
    EXPECT_GT(dark, 2);
    EXPECT_GT(partly, 2);
}

TEST_F(LightsTest, AllKindsAddToTheProbe) {
    const auto centre = [&] { return glm::dvec3(at(draw(), 0.1F, 0.1F)); };
    renderer_.set_probe(even_light(1.0F));
    const glm::dvec3 around = centre();
    renderer_.set_probe(even_light(0.0F));
    const scene::PunctualLight light{.intensity = glm::vec3(0.3F)};
    add_punctual(light, glm::translate(glm::mat4(1.0F), {0.0F, 0.0F, 1.0F}));
    add_directional({0.3F, 0.0F, 1.0F}, glm::vec3(0.7F));
    const glm::dvec3 direct = centre();
    const glm::vec3 position = position_of(0.1F, 0.1F);
    expect_equal(glm::vec4(glm::vec3(direct), 1.0F),
                 reflected(position, {0.3, 0.0, 1.0}) * 0.7 +
                     reflected(position, light, {0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -1.0F}));
    renderer_.set_probe(even_light(1.0F));
    expect_equal(glm::vec4(glm::vec3(centre()), 1.0F), around + direct);
}

}  // namespace
}  // namespace rowland::render
