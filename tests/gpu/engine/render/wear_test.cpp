// What marks of use do to a surface, against their formulas.

#include <utility>

#include "engine/render/surface_textures.h"
#include "tests/gpu/render_test.h"

namespace rowland::render {
namespace {

constexpr double kPi = 3.14159265358979;
// Three look-ups of one radiance, and the reflectance of the split-sum table.
constexpr float kLobeError = 5e-3F;

class WearTest : public test::RenderTest {
 protected:
    /// A map of one texel. `twice`: cosine and sine of twice the scratches' angle, times their coverage.
    static SurfaceTexture wear(float dust, float grease, glm::vec2 twice = glm::vec2(0.0F)) {
        return texture(1, {glm::vec4(glm::vec2(dust, grease), (128.0F + 127.0F * twice) / 255.0F)});
    }

    /// The square's middle, seen along its normal.
    glm::vec4 middle(StandardMaterial material, const SurfaceTexture& map) {
        material.wear_texture = map;
        const ecs::Entity entity = add(square(), material);
        const glm::vec4 pixel = at(draw(), 0.0F, 0.0F);
        world_.destroy(entity);
        return pixel;
    }

    static constexpr glm::vec3 kGold{0.9F, 0.6F, 0.2F};
    const StandardMaterial mirror_{.base_colour = kGold, .metallic = 1.0F, .roughness = 0.0F};
};

TEST_F(WearTest, AMapWithoutMarksChangesNothing) {
    renderer_.set_probe(even_light(0.7F));
    set_sun({0.3F, 0.2F, 1.0F}, false);
    const StandardMaterial rough{.base_colour = kGold, .metallic = 0.4F, .roughness = 0.5F};
    EXPECT_EQ(middle(rough, wear(0.0F, 0.0F)), middle(rough, {}));
}

TEST_F(WearTest, DustCoversTheSurfaceAndIsLitLikePaper) {
    renderer_.set_probe(even_light(0.8F));
    const glm::vec4 bare = middle(mirror_, {});
    const glm::vec3 dust(0.5F, 0.48F, 0.45F);
    for (const float covered : {0.25F, 1.0F}) {
        const glm::vec4 pixel = middle(mirror_, wear(covered, 0.0F));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(pixel[c], covered * 0.8F * dust[c] + (1.0F - covered) * bare[c], 1e-4F) << covered;
    }
    renderer_.set_probe(even_light(0.0F));
    set_sun({0.6F, 0.0F, 0.8F}, false);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(middle(mirror_, wear(1.0F, 0.0F))[c], 3.0F * 0.8F / static_cast<float>(kPi) * dust[c], 1e-4F);
}

/// Scratches take no light: under light from everywhere a mirror with them looks like one without.
TEST_F(WearTest, ScratchesOnlyTurnLight) {
    renderer_.set_probe(even_light(1.0F));
    for (const glm::vec2 twice : {glm::vec2(1.0F, 0.0F), glm::vec2(0.3F, -0.4F)}) {
        const glm::vec4 pixel = middle(mirror_, wear(0.0F, 0.0F, twice));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], kGold[c], kLobeError);
    }
}

/// Scratches cost look-ups and a term for each light: a material without them has a program without their code.
TEST_F(WearTest, AMaterialWithoutScratchesHasNoCodeForThem) {
    scene::MaterialDescription description;
    const scene::ImportedScene scene;
    SurfaceTextures textures(scene);
    for (const float scratches : {0.0F, 0.1F}) {
        description.wear = scene::Wear{.scratches = scratches, .dust = 0.5F};
        EXPECT_EQ(make_material(&description, textures).scratched, scratches > 0.0F);
    }
    renderer_.set_probe(even_light(1.0F));
    set_sun({0.0F, 0.2F, 1.0F}, false);
    StandardMaterial unscratched = mirror_;
    unscratched.scratched = false;
    const SurfaceTexture map = wear(0.0F, 0.0F, {1.0F, 0.0F});
    EXPECT_EQ(middle(unscratched, map), middle(mirror_, {}));
    EXPECT_NE(middle(mirror_, map), middle(mirror_, {}));
}

TEST_F(WearTest, GreaseIsRoughness) {
    renderer_.set_probe(even_light(1.0F));
    set_sun({0.2F, 0.0F, 1.0F}, false);
    for (const float grease : {0.4F, 1.0F}) {
        StandardMaterial rough = mirror_;
        rough.roughness = 0.5F * grease;
        EXPECT_EQ(middle(mirror_, wear(0.0F, grease)), middle(rough, {})) << grease;
    }
}

/// The light of a slit: a line of directions across the scratch, with its fringes.
TEST_F(WearTest, AScratchDiffractsLightAcrossItself) {
    const auto expected = [&](const glm::dvec3& l, double angle, int c) {
        const glm::dvec3 along(std::cos(angle), -std::sin(angle), 0.0);  // v grows downwards
        const glm::dvec3 across = glm::cross(glm::dvec3(0.0, 0.0, 1.0), along);
        const double variance = 4e-4;
        const double u_t = glm::dot(l, along);
        const glm::dvec3 wavelengths(0.61, 0.55, 0.465);
        const double width = 2.5 + 1.5 * std::sin(9.0 * angle);
        const double x = kPi * width * glm::dot(l, across) / wavelengths[c];
        const double slit = width / wavelengths[c] * std::pow(std::abs(x) < 1e-9 ? 1.0 : std::sin(x) / x, 2.0);
        return 3.0 * l.z * std::exp(-0.5 * u_t * u_t / variance) / std::sqrt(2.0 * kPi * variance) * slit * kGold[c];
    };
    for (const double angle : {0.0, 0.4, -0.9, 1.5}) {
        const glm::vec2 twice(std::cos(2.0 * angle), std::sin(2.0 * angle));
        const glm::dvec3 across(std::sin(angle), std::cos(angle), 0.0);
        double brightest = 0.0;
        const glm::dvec3 along(std::cos(angle), -std::sin(angle), 0.0);
        for (const auto& [away, aside] :
             {std::pair(-0.35, 0.0), std::pair(-0.1, 0.02), std::pair(0.05, -0.03), std::pair(0.2, 0.0)}) {
            const glm::dvec3 l = glm::normalize(glm::dvec3(0.0, 0.0, 1.0) + away * across + aside * along);
            set_sun(glm::vec3(l), false);
            world_.get<scene::DirectionalLight>(sun_).angular_radius = 0.0F;
            const glm::vec4 pixel = middle(mirror_, wear(0.0F, 0.0F, twice));
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(pixel[c], expected(l, angle, c), 2e-3 * expected(l, angle, c) + 1e-3)
                    << angle << ", " << away << ", " << aside;
                brightest = std::max(brightest, expected(l, angle, c));
            }
        }
        EXPECT_GT(brightest, 5.0);
        // Nothing of it goes along the scratch.
        const glm::dvec3 beside = glm::normalize(along + glm::dvec3(0.0, 0.0, 4.0));
        set_sun(glm::vec3(beside), false);
        EXPECT_LT(middle(mirror_, wear(0.0F, 0.0F, twice)).g, 1e-3F);
    }
}

}  // namespace
}  // namespace rowland::render
