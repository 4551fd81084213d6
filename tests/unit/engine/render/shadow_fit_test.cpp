#include "engine/render/shadow_fit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <random>
#include <vector>

namespace rowland::render {
namespace {

constexpr int kSize = 1024;
const Sphere kEverything{{0.0F, 0.0F, 0.0F}, 1000.0F};

glm::vec3 corner(const scene::Bounds& box, unsigned i) {
    return {(i & 1U) ? box.maximum.x : box.minimum.x, (i & 2U) ? box.maximum.y : box.minimum.y,
            (i & 4U) ? box.maximum.z : box.minimum.z};
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
            for (unsigned i = 0; i < 8; ++i) {
                const glm::vec4 clip = view.world_to_clip * glm::vec4(corner(box, i), 1.0F);
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

}  // namespace
}  // namespace rowland::render
