// What mirrors show of the plane they stand on, against rays.
#include <algorithm>

#include "tests/gpu/engine/render/traced_scene.h"

namespace rowland::render {
namespace {

/// A mirror sphere over a floor of four colours, in even light.
class LocalReflectionTest : public test::TracedSceneTest {
 protected:
    LocalReflectionTest() {
        renderer_.set_probe(even_light(1.0F));
        world_.get<StandardMaterial>(floor_).base_colour_texture = texture(kMap, quarters());
        world_.add(floor_, top_of(*world_.get<MeshInstance>(floor_).mesh));
        add_sphere({0.0F, 0.05F, 0.0F}, 0.05F, kMirror);
    }
    /// kTexels as a map of more texels, between which little is filtered.
    static std::vector<glm::vec4> quarters() {
        std::vector<glm::vec4> texels;
        for (int row = 0; row < kMap; ++row)
            for (int column = 0; column < kMap; ++column)
                texels.push_back(kTexels[static_cast<std::size_t>(2 * (2 * row / kMap) + 2 * column / kMap)]);
        return texels;
    }
    void reflect(bool on) { renderer_.set_effects({.local_reflections = on}); }
    /// The floor's green albedo: texture coordinates grow with x and against z.
    static double albedo(const glm::dvec3& point) {
        const std::size_t column = point.x > 0.0 ? 1 : 0;
        const std::size_t row = point.z < 0.0 ? 1 : 0;
        return static_cast<double>(kTexels[2 * row + column].g);
    }
    struct Reflected {
        std::size_t pixel;
        std::optional<Hit> floor;
        double gloss = 0.0;  ///< of the floor toward the mirror, in even light of 1
    };
    /// What the floor's lobe reflects of even light.
    static double lobe(double cosine) {
        static const std::vector<glm::vec2> table = bake_brdf_table(kTable);
        const glm::dvec2 split(table[kTable * (kTable - 1) + static_cast<std::size_t>(cosine * kTable)]);
        return 0.04 * split.x + split.y;
    }
    /// Of the pixels that show the sphere, where their mirrored rays meet the floor.
    std::vector<Reflected> reflected() const {
        std::vector<Reflected> result;
        for_each_mirrored({0.0F, 0.05F, 0.0F}, 0.05F,
                          [&](std::size_t pixel, const glm::dvec3& mirrored, const std::optional<Hit>& met) {
                              const bool inside =
                                  met && glm::max(std::abs(met->point.x), std::abs(met->point.z)) < kFloor;
                              result.push_back({pixel, inside ? met : std::nullopt, inside ? lobe(-mirrored.y) : 0.0});
                          });
        return result;
    }

    static constexpr int kMap = 128;
    static constexpr std::size_t kTable = 64;
    static inline const std::vector<glm::vec4> kTexels = {
        {0.1F, 0.1F, 0.1F, 1.0F}, {0.3F, 0.3F, 0.3F, 1.0F}, {0.5F, 0.5F, 0.5F, 1.0F}, {0.7F, 0.7F, 0.7F, 1.0F}};
    const StandardMaterial kMirror{.base_colour = glm::vec3(1.0F), .metallic = 1.0F, .roughness = 0.0F};
};

TEST_F(LocalReflectionTest, AMirrorShowsThePlaneWhereItsRaysMeetIt) {
    reflect(true);
    const std::vector<float> shown = greens();
    int wrong = 0;
    int of_floor = 0;
    const auto pixels = reflected();
    for (const Reflected& one : pixels) {
        of_floor += one.floor ? 1 : 0;
        const double expected = one.floor ? albedo(one.floor->point) + one.gloss : 1.0;
        wrong += std::abs(shown[one.pixel] - expected) > 0.02 ? 1 : 0;
    }
    EXPECT_GT(of_floor, 300);
    EXPECT_GT(static_cast<int>(pixels.size()) - of_floor, 300);
    // Along the lines between the colours and the floor's edge, where a pixel shows both.
    EXPECT_LT(wrong, static_cast<int>(pixels.size()) / 12);
}

TEST_F(LocalReflectionTest, ThePlanesMapMayHaveLevelsAndAnAnisotropicFilter) {
    auto map = std::make_shared<gpu::Texture>(
        gpu::TextureDesc{.format = gpu::Format::RGBA32F, .width = 64, .height = 64, .levels = 0},
        gpu::Sampling{.filter = gpu::Filter::Trilinear, .anisotropy = gpu::max_anisotropy()});
    map->upload(std::span<const glm::vec4>(std::vector<glm::vec4>(std::size_t{64} * 64, glm::vec4(0.25F))));
    map->generate_levels();
    world_.get<StandardMaterial>(floor_).base_colour_texture.texture = map;
    reflect(true);
    const std::vector<float> shown = greens();
    for (const Reflected& one : reflected())
        if (one.floor && glm::length(one.floor->point) < 0.5) {
            ASSERT_NEAR(shown[one.pixel], 0.25 + one.gloss, 0.01);
        }
}

TEST_F(LocalReflectionTest, ThePlaneIsLitByTheProbeAndTheLampAndHasItsShadow) {
    renderer_.set_probe(even_light(0.5F));
    const glm::vec3 toward = glm::normalize(glm::vec3(0.4F, 0.8F, -0.3F));
    world_.add(world_.create(),
               scene::DirectionalLight{.direction = toward, .irradiance = glm::vec3(3.0F), .casts_shadow = true});
    reflect(true);
    const std::vector<float> shown = greens();
    const double lamp = 3.0 * static_cast<double>(toward.y) / std::numbers::pi;
    int wrong = 0;
    int shadowed = 0;
    int counted = 0;
    for (const Reflected& one : reflected()) {
        if (!one.floor) continue;
        const bool in_shadow = trace(one.floor->point + glm::dvec3(0.0, 1e-6, 0.0), glm::dvec3(toward)).has_value();
        ++counted;
        shadowed += in_shadow ? 1 : 0;
        const double expected = albedo(one.floor->point) * (0.5 + (in_shadow ? 0.0 : lamp)) + 0.5 * one.gloss;
        wrong += std::abs(shown[one.pixel] - expected) > 0.05 * expected + 0.01 ? 1 : 0;
    }
    EXPECT_GT(shadowed, 20);
    // Also the highlight of the lamp and the shadow's outline.
    EXPECT_LT(wrong, counted / 6);
}

TEST_F(LocalReflectionTest, ARoughMirrorShowsABlurredEdge) {
    world_.get<StandardMaterial>(floor_).base_colour_texture = {};
    world_.get<StandardMaterial>(floor_).base_colour = glm::vec3(0.0F);
    const auto partly_floor = [&](float roughness) {
        world_.view<StandardMaterial>().each([&](ecs::Entity, StandardMaterial& material) {
            if (material.metallic > 0.5F) material.roughness = roughness;
        });
        reflect(false);
        const std::vector<float> open = greens();
        reflect(true);
        const std::vector<float> shown = greens();
        return std::ranges::count_if(reflected(), [&](const Reflected& one) {
            const float part = shown[one.pixel] / open[one.pixel];
            return part > 0.1F && part < 0.9F;
        });
    };
    const auto of_smooth = partly_floor(0.0F);
    EXPECT_GT(partly_floor(0.5F), 3 * of_smooth + 10);
}

TEST_F(LocalReflectionTest, OffOrWithoutAPlaneNothingChanges) {
    const std::vector<float> before = greens();
    const int programs = renderer_.report().programs;
    reflect(true);
    EXPECT_NE(greens(), before);
    world_.remove<ReflectedTop>(floor_);
    EXPECT_EQ(greens(), before);
    reflect(false);
    EXPECT_EQ(greens(), before);
    EXPECT_EQ(renderer_.report().programs, programs + 2);  // the mirror's and the floor's with the effect
}

/// A mirror sphere between a box and two spheres, each of one radiance.
class ObjectReflectionTest : public test::TracedSceneTest {
 protected:
    ObjectReflectionTest() {
        renderer_.set_probe(even_light(kSky));
        camera_ = {.eye = {0.1F, 0.2F, 0.6F}, .target = kMiddle, .vertical_field_of_view = 0.17F};
        mirror_ = add_sphere(kMiddle, kRadius, {.base_colour = glm::vec3(1.0F), .metallic = 1.0F, .roughness = 0.0F});
        world_.add(mirror_, ReflectsObjects{mirror_});
        set_radiance(add_box({0.14F, 0.0F, 0.06F}, {0.06F, 0.1F, 0.05F}), kBox);
        set_radiance(add_sphere({-0.1F, 0.03F, 0.08F}, 0.03F), kNear);
        far_ = add_sphere({0.0F, 0.06F, 0.3F}, 0.06F);
        set_radiance(far_, kFar);
        renderer_.set_effects({.object_reflections = true});
    }
    void set_radiance(ecs::Entity entity, double radiance) {
        auto& material = world_.get<StandardMaterial>(entity);
        material.base_colour = glm::vec3(static_cast<float>(radiance));
        material.unlit = true;
    }
    /// Of the object that a ray has met, by where it did.
    static double radiance(const std::optional<Hit>& met) {
        if (!met || met->point.y < 1e-6) return static_cast<double>(kSky);
        if (met->point.z > 0.2) return kFar;
        return met->point.x > 0.1 ? kBox : kNear;
    }
    /// What the mirror shows at each pixel: an object's radiance, the sky's, or 0 at its outline and beside it.
    std::vector<double> expected() const {
        std::vector<double> result(static_cast<std::size_t>(kWidth * kHeight), 0.0);
        for_each_mirrored(kMiddle, kRadius,
                          [&](std::size_t pixel, const glm::dvec3& /*mirrored*/, const std::optional<Hit>& met) {
                              result[pixel] = radiance(met);
                          });
        return result;
    }
    /// Whether all pixels at most so many away are expected to show the same.
    static bool even(const std::vector<double>& expected, int column, int row, int reach) {
        for (int y = row - reach; y <= row + reach; ++y)
            for (int x = column - reach; x <= column + reach; ++x)
                if (expected[index(x, y)] != expected[index(column, row)]) return false;
        return true;
    }

    static constexpr float kSky = 1.0F;
    static constexpr int kReach = 2;
    static constexpr double kBox = 0.2;
    static constexpr double kNear = 0.4;
    static constexpr double kFar = 0.6;
    static constexpr float kRadius = 0.05F;
    static constexpr glm::vec3 kMiddle{0.0F, 0.06F, 0.0F};
    ecs::Entity mirror_;
    ecs::Entity far_;
};

TEST_F(ObjectReflectionTest, AMirrorShowsObjectsWhereItsRaysMeetThem) {
    world_.destroy(floor_);
    const std::vector<float> shown = greens();
    const std::vector<double> expected = this->expected();
    for (const double object : {kBox, kNear, kFar, static_cast<double>(kSky)}) {
        int inside = 0;
        int wrong = 0;
        for (int row = kReach; row < kHeight - kReach; ++row)
            for (int column = kReach; column < kWidth - kReach; ++column) {
                // Outlines are blurred by a texel of the surroundings.
                if (expected[index(column, row)] != object || !even(expected, column, row, kReach)) continue;
                ++inside;
                wrong += std::abs(static_cast<double>(shown[index(column, row)]) - object) > 0.02 ? 1 : 0;
            }
        EXPECT_GT(inside, 30) << object;
        EXPECT_LE(wrong, inside / 500) << object;
    }
}

TEST_F(ObjectReflectionTest, TheSurroundingsAreDrawnAgainOnlyAfterAChange) {
    const std::vector<float> first = greens();
    EXPECT_GT(renderer_.report().reflections_drawn, 0);
    EXPECT_EQ(greens(), first);
    EXPECT_EQ(renderer_.report().reflections_drawn, 0);
    camera_.eye.x += 0.1F;
    greens();
    EXPECT_EQ(renderer_.report().reflections_drawn, 0);
    camera_.eye.x -= 0.1F;
    // A face in a frame.
    const auto move = [&](float along_x) {
        world_.get<scene::WorldMatrix>(far_).matrix[3].x += along_x;
        for (int face = 1; face < ObjectReflection::kFaces; ++face) greens();
        return greens();
    };
    EXPECT_NE(move(0.05F), first);
    EXPECT_EQ(move(-0.05F), first);
    EXPECT_EQ(greens(), first);
    EXPECT_EQ(renderer_.report().reflections_drawn, 0);
    renderer_.set_probe(even_light(0.5F * kSky));
    greens();
    EXPECT_GT(renderer_.report().reflections_drawn, 0);
}

TEST_F(ObjectReflectionTest, WhatLiesBelowThePlaneThatMirrorsShowIsLeftOut) {
    renderer_.set_effects({.local_reflections = true, .object_reflections = true});
    greens();
    const int with_floor = renderer_.report().reflections_drawn;
    world_.add(floor_, top_of(*world_.get<MeshInstance>(floor_).mesh));
    world_.get<StandardMaterial>(floor_).base_colour = glm::vec3(0.5F);
    greens();
    EXPECT_LT(renderer_.report().reflections_drawn, with_floor);
}

TEST_F(ObjectReflectionTest, OffOrUnmarkedNothingChanges) {
    const std::vector<float> shown = greens();
    const int programs = renderer_.report().programs;
    world_.remove<ReflectsObjects>(mirror_);
    const std::vector<float> unmarked = greens();
    EXPECT_NE(unmarked, shown);
    EXPECT_EQ(renderer_.report().reflections_drawn, 0);
    world_.add(mirror_, ReflectsObjects{mirror_});
    renderer_.set_effects({});
    EXPECT_EQ(greens(), unmarked);
    EXPECT_EQ(renderer_.report().programs, programs);  // the mirror's without the effect is the floor's
}

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
