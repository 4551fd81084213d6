// What mirrors show of the plane they stand on, against rays.
#include <algorithm>

#include "engine/render/brdf_table.h"
#include "engine/render/local_reflection.h"
#include "engine/scene/directional_light.h"
#include "tests/gpu/engine/render/traced_scene.h"

namespace rowland::render {
namespace {

/// A mirror sphere over a floor of four colours, in even light.
class LocalReflectionTest : public test::TracedSceneTest {
 protected:
    LocalReflectionTest() {
        renderer_.set_probe(even_light(1.0F));
        world_.view<MeshInstance>().each([&](ecs::Entity entity, const MeshInstance&) { floor_ = entity; });
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
        for (int row = 0; row < kHeight; ++row)
            for (int column = 0; column < kWidth; ++column) {
                const auto hit = seen(column, row);
                if (!hit || glm::length(hit->point - glm::dvec3(0.0, 0.05, 0.0)) > 0.0501) continue;
                const glm::dvec3 incident = glm::normalize(hit->point - glm::dvec3(camera_.eye));
                // At the outline a pixel sees other rays.
                if (glm::dot(incident, hit->normal) > -0.2) continue;
                const glm::dvec3 mirrored = glm::reflect(incident, hit->normal);
                const auto met = trace(hit->point + 1e-5 * hit->normal, mirrored);
                const bool inside = met && glm::max(std::abs(met->point.x), std::abs(met->point.z)) < kFloor;
                result.push_back({index(column, row), inside ? met : std::nullopt, inside ? lobe(-mirrored.y) : 0.0});
            }
        return result;
    }

    static constexpr int kMap = 128;
    static constexpr std::size_t kTable = 64;
    static inline const std::vector<glm::vec4> kTexels = {
        {0.1F, 0.1F, 0.1F, 1.0F}, {0.3F, 0.3F, 0.3F, 1.0F}, {0.5F, 0.5F, 0.5F, 1.0F}, {0.7F, 0.7F, 0.7F, 1.0F}};
    const StandardMaterial kMirror{.base_colour = glm::vec3(1.0F), .metallic = 1.0F, .roughness = 0.0F};
    ecs::Entity floor_;
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
    map->upload(std::span<const glm::vec4>(std::vector<glm::vec4>(64 * 64, glm::vec4(0.25F))));
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

}  // namespace
}  // namespace rowland::render
