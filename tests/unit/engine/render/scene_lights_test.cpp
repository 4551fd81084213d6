#include "engine/render/scene_lights.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/scene/directional_light.h"
#include "engine/scene/punctual_light.h"
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
              feature::kLights & ~(feature::kKeyLights | feature::kEffects));  // those are the probe's
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

}  // namespace
}  // namespace rowland::render
