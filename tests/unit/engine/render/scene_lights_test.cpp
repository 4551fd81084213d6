#include <gtest/gtest.h>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <vector>

#include "engine/render/scene_lights.h"
#include "engine/scene/camera.h"
#include "engine/scene/light.h"
#include "engine/scene/transform.h"

namespace rowland::render {
namespace {

void add_directional(ecs::World& world, float irradiance, bool casts_shadow) {
    world.add(world.create(), scene::DirectionalLight{.direction = {irradiance, 0.0F, 0.0F},
                                                      .irradiance = glm::vec3(irradiance),
                                                      .casts_shadow = casts_shadow});
}

TEST(SceneLights, TheLightThatCastsTheShadowComesFirst) {
    ecs::World world;
    add_directional(world, 1.0F, false);
    add_directional(world, 2.0F, true);
    add_directional(world, 3.0F, true);  // at most one casts: the first
    world.add(world.create(), scene::PunctualLight{.intensity = glm::vec3(4.0F)});
    const SceneLights lights = gather_lights(world, glm::dmat3(1.0));
    EXPECT_EQ(lights.block.light_counts.x, 3.0F);
    EXPECT_EQ(lights.block.light_counts.y, 4.0F);
    EXPECT_EQ(lights.block.lights[0].strength.x, 2.0F);
    EXPECT_EQ(lights.block.lights[1].strength.x, 1.0F);
    EXPECT_EQ(lights.block.lights[2].strength.x, 3.0F);
    EXPECT_EQ(lights.block.lights[3].strength.x, 4.0F);
    EXPECT_EQ(lights.shadow_light, glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_EQ(lights.features(),
              feature::kLights & ~(feature::kKeyLights | feature::kLocalProbe | feature::kLightPart |
                                   feature::kEffects));  // those are the probe's
}

TEST(SceneLights, AFrameHasTheFeaturesOfItsLightsOnly) {
    ecs::World world;
    EXPECT_EQ(gather_lights(world, glm::dmat3(1.0)).features(), 0U);
    world.add(world.create(), scene::PunctualLight{});
    EXPECT_EQ(gather_lights(world, glm::dmat3(1.0)).features(), feature::kPunctualLights);
    add_directional(world, 1.0F, false);
    EXPECT_EQ(gather_lights(world, glm::dmat3(1.0)).features(), feature::kPunctualLights | feature::kDirectionalLights);
    add_directional(world, 1.0F, false);
    EXPECT_EQ(gather_lights(world, glm::dmat3(1.0)).features(),
              feature::kPunctualLights | feature::kDirectionalLights | feature::kSeveralDirectionalLights);
}

TEST(SceneLights, CountsThoseThatDoNotFit) {
    ecs::World world;
    for (int i = 0; i < 60; ++i) add_directional(world, 1.0F, false);
    for (int i = 0; i < 9; ++i) world.add(world.create(), scene::PunctualLight{});
    const SceneLights lights = gather_lights(world, glm::dmat3(1.0));
    EXPECT_EQ(lights.dropped, 5);
    EXPECT_EQ(lights.block.light_counts.x, 60.0F);
    EXPECT_EQ(lights.block.light_counts.y, 64.0F);
}

TEST(SceneLights, StrengthIsInTheWorkingSpace) {
    ecs::World world;
    add_directional(world, 1.0F, false);
    glm::dmat3 swap(0.0);
    swap[0][1] = 2.0;  // red becomes twice as much green
    EXPECT_EQ(glm::vec3(gather_lights(world, swap).block.lights[0].strength), glm::vec3(0.0F, 2.0F, 0.0F));
}

TEST(SceneLights, StrengthsAreInTheShadersOrder) {
    ecs::World world;
    for (int i = 0; i < 70; ++i) add_directional(world, static_cast<float>(i + 1), i == 5);
    const SceneLights lights = gather_lights(world, glm::dmat3(1.0));
    ASSERT_EQ(lights.strengths.size(), 64U);
    EXPECT_EQ(lights.strengths[0], glm::vec3(6.0F));  // casts the shadow
    for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(lights.strengths[i], glm::vec3(lights.block.lights[i].strength));
}

TEST(SceneLights, DirectionalLightsAreTurnedByTheirMatrices) {
    ecs::World world;
    const ecs::Entity turned = world.create();
    world.add(turned, scene::DirectionalLight{.direction = {0.0F, 0.0F, 1.0F}, .irradiance = {1.0F, 0.0F, 0.0F}});
    world.add(turned, scene::WorldMatrix{glm::rotate(glm::mat4(1.0F), 1.5707963F, {0.0F, 1.0F, 0.0F})});
    const std::vector<DistantLight> lights = distant_lights(world);
    ASSERT_EQ(lights.size(), 1U);
    EXPECT_NEAR(lights[0].direction.x, 1.0F, 1e-6F);
    EXPECT_NEAR(lights[0].direction.z, 0.0F, 1e-6F);
    EXPECT_EQ(lights[0].irradiance, glm::vec3(1.0F, 0.0F, 0.0F));
}

constexpr int kSize = 1024;
const Sphere kEverything{{0.0F, 0.0F, 0.0F}, 1000.0F};

std::array<glm::vec3, 8> corners(const scene::Bounds& box) {
    std::array<glm::vec3, 8> result;
    for (std::size_t i = 0; i < 8; ++i)
        result[i] = {(i & 1U) ? box.maximum.x : box.minimum.x, (i & 2U) ? box.maximum.y : box.minimum.y,
                     (i & 4U) ? box.maximum.z : box.minimum.z};
    return result;
}

std::vector<scene::Bounds> random_boxes(unsigned seed, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-3.0F, 3.0F);
    std::vector<scene::Bounds> boxes;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 centre(uniform(random), uniform(random), uniform(random));
        boxes.push_back({centre - 0.3F, centre + 0.2F});
    }
    return boxes;
}

TEST(ShadowFit, AllCastersLieInsideTheMap) {
    for (unsigned seed = 1; seed < 20; ++seed) {
        const std::vector<scene::Bounds> casters = random_boxes(seed, 5);
        const glm::vec3 light = glm::normalize(casters[0].minimum);
        const ShadowView view = fit_shadow(light, casters, kEverything, kSize);
        for (const scene::Bounds& box : casters) {
            EXPECT_TRUE(view.may_see(box));
            for (const glm::vec3& corner : corners(box)) {
                const glm::vec4 clip = view.world_to_clip * glm::vec4(corner, 1.0F);
                for (int axis = 0; axis < 3; ++axis) EXPECT_LT(std::abs(clip[axis]), 1.0F);
                EXPECT_EQ(clip.w, 1.0F);
            }
        }
    }
}

TEST(ShadowFit, NearerToTheLightIsNearerInTheMap) {
    const std::vector<scene::Bounds> casters = {{{-1, -1, -1}, {1, 1, 1}}};
    const glm::vec3 light = glm::normalize(glm::vec3(0.3F, 1.0F, -0.4F));
    const ShadowView view = fit_shadow(light, casters, kEverything, kSize);
    const glm::vec4 low = view.world_to_clip * glm::vec4(-0.5F * light, 1.0F);
    const glm::vec4 high = view.world_to_clip * glm::vec4(0.5F * light, 1.0F);
    EXPECT_LT(high.z, low.z);
    EXPECT_NEAR(high.x, low.x, 1e-5F);
    EXPECT_NEAR(high.y, low.y, 1e-5F);
}

TEST(ShadowFit, ATexelIsAsWideAsItSays) {
    const std::vector<scene::Bounds> casters = {{{-1, -1, -1}, {1, 1, 1}}};
    const ShadowView view = fit_shadow({0.0F, 1.0F, 0.0F}, casters, kEverything, kSize);
    // 2 m over kSize − 8 texels, rounded up by at most 2^¼.
    EXPECT_GE(view.texel_m, 2.0F / (kSize - 8));
    EXPECT_LE(view.texel_m, 2.0F * std::exp2(0.25F) / (kSize - 8) * 1.0001F);
    const glm::vec4 moved = view.world_to_clip * glm::vec4(view.texel_m, 0.0F, 0.0F, 0.0F);
    EXPECT_NEAR(glm::length(glm::vec2(moved)), 2.0F / kSize, 1e-6F);
}

TEST(ShadowFit, TexelsStayInPlaceWhenCameraAndCastersMove) {
    const glm::vec3 light = glm::normalize(glm::vec3(0.5F, 1.0F, 0.2F));
    std::vector<scene::Bounds> casters = random_boxes(5, 3);
    const glm::vec4 point(0.21F, 0.34F, -0.4F, 1.0F);
    std::vector<glm::vec2> places;
    float texel = 0.0F;
    for (int i = 0; i < 30; ++i) {
        casters[0].minimum.x += 0.001F;
        casters[0].maximum.x += 0.001F;
        const Sphere seen{{0.01F * static_cast<float>(i), 0.0F, 0.0F}, 2.5F};
        const ShadowView view = fit_shadow(light, casters, seen, kSize);
        if (texel != view.texel_m) places.clear();  // one step of size is allowed on the way
        texel = view.texel_m;
        places.emplace_back(0.5F * kSize * glm::vec2(view.world_to_clip * point));
        const glm::vec2 shift = places.back() - places.front();
        // Whole texels; floats of some hundred texels.
        EXPECT_NEAR(shift.x, std::round(shift.x), 2e-3F);
        EXPECT_NEAR(shift.y, std::round(shift.y), 2e-3F);
    }
    EXPECT_GT(places.size(), 10U);
    EXPECT_GT(glm::length(places.back() - places.front()), 0.9F);  // it did move
}

TEST(ShadowFit, SpendsItsTexelsOnWhatIsSeenAndKeepsWhatCastsIntoIt) {
    // A long row of casters, of which the camera sees a metre around the origin.
    std::vector<scene::Bounds> casters;
    for (int i = -50; i <= 50; ++i) {
        const glm::vec3 centre(static_cast<float>(i), 0.0F, 0.0F);
        casters.push_back({centre - 0.1F, centre + 0.1F});
    }
    casters.push_back({{-0.1F, 30.0F, -0.1F}, {0.1F, 30.5F, 0.1F}});  // high above
    const ShadowView view = fit_shadow({0.0F, 1.0F, 0.0F}, casters, {{0.0F, 0.0F, 0.0F}, 1.0F}, kSize);
    EXPECT_LT(view.texel_m, 2.0F * std::exp2(0.25F) / (kSize - 8) * 1.0001F);
    EXPECT_TRUE(view.may_see(casters.back()));
    EXPECT_GT((view.world_to_clip * glm::vec4(0.0F, 30.5F, 0.0F, 1.0F)).z, -1.0F);
    EXPECT_FALSE(view.may_see(casters.front()));
}

TEST(AroundView, HoldsTheCornersOfTheViewAndIsTheSameSizeHoweverTheCameraTurns) {
    scene::Camera camera{.eye = {1.0F, 2.0F, 3.0F}, .target = {0.0F, 0.0F, 0.0F}, .far_plane = 4.0F};
    const Sphere sphere = around_view(camera, 1.5F, 4.0F);
    const glm::mat4 back = glm::inverse(camera.projection(1.5F) * camera.view());
    for (unsigned i = 0; i < 8; ++i) {
        const glm::vec4 world = back * glm::vec4((i & 1U) ? 1 : -1, (i & 2U) ? 1 : -1, (i & 4U) ? 1 : -1, 1.0F);
        EXPECT_LE(glm::length(glm::vec3(world) / world.w - sphere.centre), sphere.radius * 1.0001F);
    }
    camera.target = {5.0F, 1.0F, -2.0F};
    EXPECT_EQ(around_view(camera, 1.5F, 4.0F).radius, sphere.radius);
    EXPECT_LT(around_view(camera, 1.5F, 1.0F).radius, sphere.radius);  // what is seen ends nearer
}

glm::mat4 random_matrix(std::mt19937& random) {
    std::uniform_real_distribution<float> uniform(-2.0F, 2.0F);
    glm::mat4 matrix(1.0F);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) matrix[c][r] = uniform(random);
    return matrix;
}

TEST(WorldBounds, TransformedBoxIsTheTightestAroundTheCorners) {
    std::mt19937 random(1);
    for (int i = 0; i < 50; ++i) {
        const scene::Bounds box{{-1.0F, 0.5F, -3.0F}, {2.0F, 0.75F, 1.0F}};
        const glm::mat4 matrix = random_matrix(random);
        scene::Bounds expected{glm::vec3(1e9F), glm::vec3(-1e9F)};
        for (const glm::vec3& corner : corners(box)) {
            const glm::vec3 moved(matrix * glm::vec4(corner, 1.0F));
            expected = {glm::min(expected.minimum, moved), glm::max(expected.maximum, moved)};
        }
        const scene::Bounds found = transformed(box, matrix);
        for (int axis = 0; axis < 3; ++axis) {  // a few additions of numbers around 10
            EXPECT_NEAR(found.minimum[axis], expected.minimum[axis], 1e-5F);
            EXPECT_NEAR(found.maximum[axis], expected.maximum[axis], 1e-5F);
        }
    }
}

TEST(WorldBounds, UnitedHoldsAllAndNothingOfNothing) {
    EXPECT_FALSE(united({}).has_value());
    const std::vector<scene::Bounds> boxes = {{{0, 0, 0}, {1, 1, 1}}, {{-2, 0.5F, 0}, {-1, 3, 0.5F}}};
    const scene::Bounds all = united(boxes).value();
    EXPECT_EQ(all.minimum, glm::vec3(-2, 0, 0));
    EXPECT_EQ(all.maximum, glm::vec3(1, 3, 1));
}

TEST(WorldBounds, PosedBoundsHoldEveryBlendOfTheJoints) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    const scene::Bounds box{{-1.0F, -1.0F, 0.0F}, {1.0F, 2.0F, 1.0F}};
    const std::vector<glm::mat4> joints = {random_matrix(random), random_matrix(random), random_matrix(random)};
    const scene::Bounds posed = posed_bounds(box, joints);
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 vertex =
            glm::mix(box.minimum, box.maximum, glm::vec3(unit(random), unit(random), unit(random)));
        glm::vec3 weights(unit(random), unit(random), unit(random));
        weights /= weights.x + weights.y + weights.z;
        glm::vec3 moved(0.0F);
        for (int j = 0; j < 3; ++j)
            moved += weights[j] * glm::vec3(joints[static_cast<std::size_t>(j)] * glm::vec4(vertex, 1.0F));
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(moved[axis], posed.minimum[axis] - 1e-5F);
            EXPECT_LE(moved[axis], posed.maximum[axis] + 1e-5F);
        }
    }
}

TEST(Frustum, NeverHidesABoxWithAPointInView) {
    const scene::Camera camera{.eye = {1.0F, 2.0F, 5.0F}, .target = {0.0F, 0.5F, 0.0F}, .far_plane = 20.0F};
    const glm::mat4 view_projection = camera.projection(1.6F) * camera.view();
    const Frustum frustum(view_projection);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-12.0F, 12.0F);
    int seen = 0;
    int hidden = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 centre(uniform(random), uniform(random), uniform(random));
        const scene::Bounds box{centre - 0.7F, centre + 0.7F};
        const glm::vec4 clip = view_projection * glm::vec4(centre, 1.0F);
        const bool in_view = glm::all(glm::lessThanEqual(glm::abs(glm::vec3(clip)), glm::vec3(clip.w)));
        EXPECT_TRUE(frustum.may_see(box) || !in_view);
        seen += in_view ? 1 : 0;
        hidden += frustum.may_see(box) ? 0 : 1;
    }
    EXPECT_GT(seen, 100);
    EXPECT_GT(hidden, 1000);
}

TEST(Frustum, HidesWhatIsBeyondEachPlane) {
    const scene::Camera camera{.eye = {0.0F, 0.0F, 0.0F},
                               .target = {0.0F, 0.0F, -1.0F},
                               .vertical_field_of_view = 1.5707963F,
                               .near_plane = 1.0F,
                               .far_plane = 10.0F};
    const Frustum frustum(camera.projection(1.0F) * camera.view());
    const auto sees = [&](const glm::vec3& centre) { return frustum.may_see({centre - 0.1F, centre + 0.1F}); };
    EXPECT_TRUE(sees({0.0F, 0.0F, -5.0F}));
    EXPECT_TRUE(sees({5.05F, 0.0F, -5.0F}));  // across the right plane
    EXPECT_FALSE(sees({5.5F, 0.0F, -5.0F}));
    EXPECT_FALSE(sees({-5.5F, 0.0F, -5.0F}));
    EXPECT_FALSE(sees({0.0F, 5.5F, -5.0F}));
    EXPECT_FALSE(sees({0.0F, -5.5F, -5.0F}));
    EXPECT_FALSE(sees({0.0F, 0.0F, -0.5F}));
    EXPECT_FALSE(sees({0.0F, 0.0F, -11.0F}));
    EXPECT_FALSE(sees({0.0F, 0.0F, 5.0F}));
}

}  // namespace
}  // namespace rowland::render
