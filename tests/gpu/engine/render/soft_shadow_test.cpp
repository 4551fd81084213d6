// Shadows of a light that is a disc, against rays to points of the disc.
#include "engine/scene/directional_light.h"
#include "tests/gpu/engine/render/traced_scene.h"

namespace rowland::render {
namespace {

class SoftShadowTest : public test::TracedSceneTest {
 protected:
    SoftShadowTest() {
        renderer_.set_shadow_map_size(2048);
        set_light(true);
    }
    void set_light(bool casts_shadow) {
        if (world_.alive(light_)) world_.destroy(light_);
        light_ = world_.create();
        world_.add(light_, scene::DirectionalLight{
                               .direction = kToward, .irradiance = glm::vec3(3.0F), .casts_shadow = casts_shadow});
    }
    /// Of the light in each pixel: a picture's ratio to the one without shadows.
    std::vector<float> visibility(float angular_radius) {
        set_light(false);
        const std::vector<float> open = greens();
        set_light(true);
        renderer_.set_effects(angular_radius > 0.0F
                                  ? Effects{.soft_shadows = SoftShadowSettings{.angular_radius = angular_radius}}
                                  : Effects{});
        std::vector<float> result = greens();
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = open[i] > 0.0F ? result[i] / open[i] : 1.0F;
        return result;
    }
    /// The fraction of the light's disc that a point sees.
    double traced_visibility(const Hit& point, double angular_radius) const {
        constexpr int kSide = 12;
        const glm::dvec3 toward(kToward);
        const auto [x, y] = axes_across(toward);
        double sum = 0.0;
        for (int i = 0; i < kSide * kSide; ++i) {
            const double radius = std::tan(angular_radius) * std::sqrt((i % kSide + 0.5) / kSide);
            const double angle = 2.0 * std::numbers::pi * (i / kSide + 0.5) / kSide;
            const glm::dvec3 direction = toward + radius * (std::cos(angle) * x + std::sin(angle) * y);
            sum += trace(point.point + 1e-6 * point.normal, glm::normalize(direction)) ? 0.0 : 1.0;
        }
        return sum / (kSide * kSide);
    }
    struct Errors {
        double in_penumbra = 0.0;  ///< mean
        double elsewhere = 0.0;
    };
    /// Of two pictures of the floor, against the light as it is.
    Errors errors_of(const std::vector<float>& shown, double angular_radius) const {
        Errors errors;
        int penumbra = 0;
        int others = 0;
        for (int row = 0; row < kHeight; ++row)
            for (int column = 0; column < kWidth; ++column) {
                const auto hit = seen(column, row);
                if (!hit || hit->point.y > 1e-6) continue;
                const double expected = traced_visibility(*hit, angular_radius);
                const bool between = expected > 0.0 && expected < 1.0;
                ++(between ? penumbra : others);
                (between ? errors.in_penumbra : errors.elsewhere) += std::abs(shown[index(column, row)] - expected);
            }
        EXPECT_GT(penumbra, 200);
        return {errors.in_penumbra / penumbra, errors.elsewhere / others};
    }

    const glm::vec3 kToward = glm::normalize(glm::vec3(-0.7F, 0.8F, -0.4F));
    ecs::Entity light_;
};

TEST_F(SoftShadowTest, AnEdgeIsAsWideAsThatOfTheDisc) {
    add_box({0.0F, 0.0F, 0.0F}, {0.05F, 0.12F, 0.05F});
    constexpr float kRadius = 0.04F;
    const Errors hard = errors_of(visibility(0.0F), kRadius);
    const Errors soft = errors_of(visibility(kRadius), kRadius);
    RecordProperty("hard", std::to_string(hard.in_penumbra));
    RecordProperty("soft", std::to_string(soft.in_penumbra));
    RecordProperty("soft_elsewhere", std::to_string(soft.elsewhere));
    EXPECT_LT(soft.in_penumbra, 0.1);
    EXPECT_LT(soft.in_penumbra, 0.5 * hard.in_penumbra);
    EXPECT_LT(soft.elsewhere, 0.01);
}

TEST_F(SoftShadowTest, UnderASphereItIsThatOfTheDisc) {
    add_sphere({0.0F, 0.08F, 0.0F}, 0.04F);
    constexpr float kRadius = 0.06F;
    const Errors soft = errors_of(visibility(kRadius), kRadius);
    RecordProperty("soft", std::to_string(soft.in_penumbra));
    EXPECT_LT(soft.in_penumbra, 0.1);
    EXPECT_LT(soft.elsewhere, 0.01);
}

TEST_F(SoftShadowTest, ASurfaceDoesNotShadowItself) {
    add_sphere({0.0F, 0.06F, 0.0F}, 0.06F);
    const std::vector<float> shown = visibility(0.05F);
    int lit = 0;
    int dark = 0;
    for (int row = 0; row < kHeight; ++row)
        for (int column = 0; column < kWidth; ++column) {
            const auto hit = seen(column, row);
            // Up to 75° from the light; facets turn away before the smooth normal does.
            if (!hit || glm::dot(hit->normal, glm::dvec3(kToward)) < 0.26 || traced_visibility(*hit, 0.05) < 1.0)
                continue;
            ++lit;
            dark += shown[index(column, row)] < 0.98F ? 1 : 0;
        }
    EXPECT_GT(lit, 5000);
    EXPECT_LT(dark, lit / 500);
}

TEST_F(SoftShadowTest, OffTheProgramsAreThoseOfBefore) {
    add_box({0.0F, 0.0F, 0.0F}, {0.05F, 0.12F, 0.05F});
    const std::vector<float> before = greens();
    const int programs = renderer_.report().programs;
    visibility(0.04F);
    visibility(0.0F);
    EXPECT_EQ(greens(), before);
    EXPECT_GT(renderer_.report().programs, programs);
}

}  // namespace
}  // namespace rowland::render
