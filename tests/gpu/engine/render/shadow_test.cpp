// The shadow of a directional light: that it is there, at the right position, and nowhere else.

#include "tests/gpu/engine/render/traced_scene.h"

namespace rowland::render {
namespace {

using scene::AlphaMode;

/// A square seen from the front under a light, and things that stand between them.
class ShadowTest : public test::RenderTest {
 protected:
    ShadowTest() {
        renderer_.set_shadow_map_size(512);
        add(square(), kGrey);
        set_sun({0.0F, 0.0F, 1.0F});
    }
    static glm::mat4 translation(float x, float y, float z) { return glm::translate(glm::mat4(1.0F), {x, y, z}); }

    const StandardMaterial kGrey{.base_colour = glm::vec3(0.5F), .roughness = 1.0F};
};

TEST_F(ShadowTest, APointUnderAnOccluderHasOnlyAmbientLightAndOneBesideItAllOfIt) {
    renderer_.set_probe(even_light(1.0F));
    const auto without = draw();
    world_.get<scene::DirectionalLight>(sun_).irradiance = glm::vec3(0.0F);
    const auto ambient = draw();
    world_.get<scene::DirectionalLight>(sun_).irradiance = glm::vec3(3.0F);
    // The camera sees the shadow because the light comes from the side: it falls from x = 0.7 on z = 0.6 to x = 0.1.
    set_sun({1.0F, 0.0F, 1.0F});
    const auto lit = draw();
    add(square(0.2F), kGrey, translation(0.7F, 0.0F, 0.6F));
    const auto pixels = draw();
    EXPECT_EQ(renderer_.report().shadow_drawn, 2);
    EXPECT_NEAR(at(pixels, 0.1F, 0.0F).g, at(ambient, 0.1F, 0.0F).g, 1e-5F);
    for (const glm::vec2 p : {glm::vec2(-0.25F, 0.0F), glm::vec2(0.1F, 0.35F), glm::vec2(0.1F, -0.35F)})
        EXPECT_NEAR(at(pixels, p.x, p.y).g, at(lit, p.x, p.y).g, 1e-5F);
    EXPECT_GT(at(lit, 0.1F, 0.0F).g, 1.5F * at(ambient, 0.1F, 0.0F).g);
    EXPECT_GT(at(without, 0.1F, 0.0F).g, at(ambient, 0.1F, 0.0F).g);
}

TEST_F(ShadowTest, OnlyALightThatCastsShadowsHasAMap) {
    add(square(0.3F), kGrey, translation(0.0F, 0.0F, 0.5F));
    set_sun({0.0F, 0.0F, 1.0F}, false);
    draw();
    EXPECT_EQ(renderer_.report().shadow_drawn, 0);
    set_sun({0.0F, 0.0F, 1.0F}, true);
    draw();
    EXPECT_EQ(renderer_.report().shadow_drawn, 2);
}

TEST_F(ShadowTest, TheSecondLightShinesIntoTheShadowOfTheFirst) {
    set_sun({1.0F, 0.0F, 1.0F});
    add(square(0.2F), kGrey, translation(0.7F, 0.0F, 0.6F));
    EXPECT_EQ(at(draw(), 0.1F, 0.0F).g, 0.0F);
    world_.add(world_.create(),
               scene::DirectionalLight{.direction = {0.0F, 0.0F, 1.0F}, .irradiance = glm::vec3(1.0F)});
    EXPECT_GT(at(draw(), 0.1F, 0.0F).g, 0.1F);
}

TEST_F(ShadowTest, WhatIsOutsideThePictureStillCastsItsShadowIntoIt) {
    set_sun({1.0F, 0.0F, 0.25F});
    const float before = at(draw(), 0.0F, 0.0F).g;
    // Far to the right, out of the picture: its shadow falls on the middle.
    const glm::mat4 turned = glm::rotate(translation(4.0F, 0.0F, 1.0F), 1.2F, {0.0F, 1.0F, 0.0F});
    add(square(0.3F), kGrey, turned);
    const float after = at(draw(), 0.0F, 0.0F).g;
    EXPECT_EQ(renderer_.report().culled, 1);
    EXPECT_GT(before, 0.05F);
    EXPECT_EQ(after, 0.0F);
}

TEST_F(ShadowTest, HolesOfAMaskLetTheLightThroughAndGlassCastsNoShadow) {
    set_sun({1.0F, 0.0F, 1.0F});
    const float open = at(draw(), 0.1F, 0.0F).g;
    StandardMaterial mask = kGrey;
    mask.alpha_mode = AlphaMode::Mask;
    mask.base_colour_texture = texture(1, {{1.0F, 1.0F, 1.0F, 0.2F}});
    const ecs::Entity entity = add(square(0.2F), mask, translation(0.7F, 0.0F, 0.6F));
    EXPECT_NEAR(at(draw(), 0.1F, 0.0F).g, open, 1e-5F);
    world_.get<StandardMaterial>(entity).alpha_cutoff = 0.1F;
    EXPECT_EQ(at(draw(), 0.1F, 0.0F).g, 0.0F);
    world_.get<StandardMaterial>(entity).alpha_mode = AlphaMode::Blend;
    EXPECT_NEAR(at(draw(), 0.1F, 0.0F).g, open, 1e-5F);
}

TEST_F(ShadowTest, SkinnedMeshesCastTheShadowOfTheirPose) {
    set_sun({1.0F, 0.0F, 1.0F});
    scene::Mesh mesh = square(0.2F);
    mesh.joints.assign(4, glm::u16vec4(0));
    mesh.weights.assign(4, {1.0F, 0.0F, 0.0F, 0.0F});
    const ecs::Entity joint = world_.create();
    world_.add(joint, scene::WorldMatrix{translation(0.7F, 0.0F, 0.6F)});
    const ecs::Entity entity = add(mesh, kGrey);
    world_.add(entity, scene::Skin{.joints = {joint}, .inverse_bind = {glm::mat4(1.0F)}});
    EXPECT_EQ(at(draw(), 0.1F, 0.0F).g, 0.0F);
    world_.get<scene::WorldMatrix>(joint).matrix = translation(0.7F, 0.7F, 0.6F);
    EXPECT_GT(at(draw(), 0.1F, 0.0F).g, 0.1F);
    EXPECT_EQ(at(draw(), 0.1F, 0.7F).g, 0.0F);
}

/// A ground that is lit at a grazing angle, with something far above to give the map depth.
class GrazingSunTest : public test::RenderTest {
 protected:
    static constexpr int kPixels = 200;

    GrazingSunTest() { camera_ = {.eye = {0.3F, 1.5F, 3.0F}, .target = {0.0F, 0.0F, 0.0F}}; }

    void add_white(scene::Mesh mesh, const glm::mat4& matrix) {
        add(std::move(mesh), {.base_colour = glm::vec3(0.8F), .roughness = 1.0F}, matrix);
    }
    static glm::vec3 toward_sun(float degrees_from_zenith, float azimuth) {
        const float zenith = glm::radians(degrees_from_zenith);
        return {std::sin(zenith) * std::cos(azimuth), std::cos(zenith), std::sin(zenith) * std::sin(azimuth)};
    }
    std::vector<glm::vec4> draw_large() {
        renderer_.render(world_, camera_, picture_);
        return picture_.read_rgba_float();
    }
    struct Darkened {
        int lit = 0;       ///< pixels whose green exceeds a threshold without a shadow map
        int darkened = 0;  ///< those of them that the map darkens by more than a hundredth
    };
    Darkened darkened(const glm::vec3& toward, float threshold) {
        set_sun(toward, false);
        const auto open = draw_large();
        set_sun(toward, true);
        const auto shadowed = draw_large();
        Darkened count;
        for (std::size_t i = 0; i < open.size(); ++i) {
            if (open[i].g <= threshold) continue;
            ++count.lit;
            count.darkened += shadowed[i].g < 0.99F * open[i].g ? 1 : 0;
        }
        return count;
    }

    const glm::mat4 kLying = glm::rotate(glm::mat4(1.0F), -1.5707963F, {1.0F, 0.0F, 0.0F});
    gpu::Framebuffer picture_{
        gpu::FramebufferDesc{.width = kPixels, .height = kPixels, .colours = {gpu::Format::RGBA32F}, .depth = true}};
};

TEST_F(GrazingSunTest, APlaneDoesNotShadowItself) {
    add_white(square(5.0F), kLying);
    for (const float azimuth : {0.0F, 0.4F, 0.785F, 2.0F, 4.4F})
        for (const float degrees : {75.0F, 20.0F}) {
            const Darkened count = darkened(toward_sun(degrees, azimuth), 0.01F);
            EXPECT_GT(count.lit, kPixels * kPixels / 4);
            EXPECT_LT(count.darkened, count.lit / 1000) << degrees << ", " << azimuth;
        }
}

TEST_F(GrazingSunTest, AShadowBeginsWhereItsCasterStands) {
    add_white(square(2.0F), kLying);
    // A wall on the plane x = 0, its foot on the ground; the sun stands at 45° over +x, so its shadow covers x < 0.
    add_white(square(0.5F),
              glm::rotate(glm::translate(glm::mat4(1.0F), {0.0F, 0.5F, 0.0F}), 1.5707963F, {0.0F, 1.0F, 0.0F}));
    camera_ = {.eye = {0.0F, 5.0F, 0.001F}, .target = {0.0F, 0.0F, 0.0F}, .vertical_field_of_view = 0.3F};
    set_sun(toward_sun(45.0F, 0.0F));
    const auto pixels = draw_large();
    // Half the picture's height, 5 tan 0.15 = 0.756 m, is half of 200 pixels. A map of 2048 texels over the 4 m ground
    // has texels of at most 4 m · 2^¼ / 2040 = 2.3 mm; lift, filter and slope bias move an edge by at most 5 of them,
    // 12 mm or 1.6 pixels, and the pixel that the edge crosses is one more.
    const auto row = pixels.begin() + std::ptrdiff_t{kPixels / 2} * kPixels;
    for (int column = kPixels / 2 - 60; column < kPixels / 2 - 3; ++column) EXPECT_EQ(row[column].g, 0.0F) << column;
    for (int column = kPixels / 2 + 3; column < kPixels; ++column) EXPECT_GT(row[column].g, 0.1F) << column;
}

TEST_F(GrazingSunTest, ASphereIsDarkenedOnlyWhereItTurnsAway) {
    add_white(scene::build_mesh(scene::SphereRecipe{.radius = 1.0}), glm::mat4(1.0F));
    camera_ = {.eye = {0.0F, 0.0F, 3.0F}, .target = {0.0F, 0.0F, 0.0F}, .vertical_field_of_view = 0.65F};
    // Facets, not the smooth normal, cast the shadow: near the terminator they turn away first.
    const Darkened count = darkened(toward_sun(60.0F, 0.0F), 0.12F);
    EXPECT_GT(count.lit, 5000);
    EXPECT_LT(count.darkened, count.lit / 1000);
}

class SoftShadowTest : public test::TracedSceneTest {
 protected:
    SoftShadowTest() { set_sun(kToward); }
    /// Of the light in each pixel: a picture's ratio to the one without shadows.
    std::vector<float> visibility(float angular_radius) {
        set_sun(kToward, false);
        const std::vector<float> open = greens();
        set_sun(kToward);
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
            const int turn = i / kSide;
            const double radius = std::tan(angular_radius) * std::sqrt((i % kSide + 0.5) / kSide);
            const double angle = 2.0 * std::numbers::pi * (turn + 0.5) / kSide;
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
};

TEST_F(SoftShadowTest, AnEdgeIsAsWideAsThatOfTheDisc) {
    add_box({0.0F, 0.0F, 0.0F}, {0.05F, 0.12F, 0.05F});
    constexpr float kRadius = 0.04F;
    const Errors hard = errors_of(visibility(0.0F), kRadius);
    const Errors soft = errors_of(visibility(kRadius), kRadius);
    EXPECT_LT(soft.in_penumbra, 0.1);
    EXPECT_LT(soft.in_penumbra, 0.5 * hard.in_penumbra);
    EXPECT_LT(soft.elsewhere, 0.01);
}

TEST_F(SoftShadowTest, UnderASphereItIsThatOfTheDisc) {
    add_sphere({0.0F, 0.08F, 0.0F}, 0.04F);
    constexpr float kRadius = 0.06F;
    const Errors soft = errors_of(visibility(kRadius), kRadius);
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
