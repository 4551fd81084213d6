#include "engine/scene/orbit_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "engine/scene/view_angles.h"

namespace rowland::scene {
namespace {

constexpr float kOrbitInfinity = std::numeric_limits<float>::infinity();
constexpr float kOrbitNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kLargest = std::numeric_limits<float>::max();

Camera orbit_start() {
    return {.eye = {1.0F, 3.0F, 4.0F}, .target = {1.0F, 0.0F, 0.0F}, .vertical_field_of_view = 0.5F};
}

float distance_of(const Camera& camera) {
    return glm::distance(camera.eye, camera.target);
}

void expect_orbit_near(glm::vec3 a, glm::vec3 b, float tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

void expect_usable(const Camera& camera) {
    const glm::mat4 view = camera.view();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) ASSERT_TRUE(std::isfinite(view[column][row]));
}

TEST(OrbitCamera, StartsAtTheGivenCamera) {
    const Camera camera = OrbitCamera(orbit_start()).camera();
    expect_orbit_near(camera.eye, orbit_start().eye, 2e-6F);  // rounding of the angles at distance 5
    EXPECT_EQ(camera.target, orbit_start().target);
    EXPECT_EQ(camera.vertical_field_of_view, 0.5F);
}

TEST(OrbitCamera, DragKeepsTheDistance) {
    OrbitCamera orbit(orbit_start());
    std::mt19937 random(3);
    std::uniform_real_distribution<float> pixels(-400.0F, 400.0F);
    for (int i = 0; i < 1000; ++i) {
        orbit.update({.drag = {pixels(random), pixels(random)}});
        EXPECT_EQ(orbit.distance(), 5.0F);
        EXPECT_NEAR(distance_of(orbit.camera()), 5.0F, 3e-6F);  // rounding of sine and cosine at distance 5
    }
}

TEST(OrbitCamera, SceneFollowsTheHand) {
    OrbitCamera orbit({.eye = {0.0F, 0.0F, 2.0F}, .target = glm::vec3(0.0F)});
    orbit.update({.drag = {100.0F, 0.0F}});
    EXPECT_LT(orbit.camera().eye.x, 0.0F);  // dragged to the right: seen from further left
    orbit.update({.drag = {0.0F, 100.0F}});
    EXPECT_GT(orbit.camera().eye.y, 0.0F);  // dragged down: seen from higher up
}

TEST(OrbitCamera, DragIsInRadiansPerPixel) {
    OrbitCamera orbit({.eye = {0.0F, 0.0F, 2.0F}, .target = glm::vec3(0.0F)}, {.radians_per_pixel = 0.01F});
    orbit.update({.drag = {-50.0F, 20.0F}});
    EXPECT_NEAR(orbit.yaw(), 0.5, 1e-7);  // the scale is float
    EXPECT_NEAR(orbit.pitch(), 0.2, 1e-7);
}

TEST(OrbitCamera, PitchEndsShortOfThePoles) {
    for (const float way : {1.0F, -1.0F}) {
        OrbitCamera orbit(orbit_start());
        orbit.update({.drag = {0.0F, way * 1e6F}});
        EXPECT_EQ(orbit.pitch(), static_cast<double>(way) * kMaximumPitch);
        expect_usable(orbit.camera());
        orbit.update({.drag = {0.0F, -way * 10.0F}});  // and comes back at once
        EXPECT_LT(std::abs(orbit.pitch()), kMaximumPitch);
    }
}

TEST(OrbitCamera, FullTurnComesBack) {
    OrbitCamera orbit(orbit_start(), {.radians_per_pixel = 6.2831853F / 1000.0F});
    for (int i = 0; i < 1000; ++i) orbit.update({.drag = {1.0F, 0.0F}});
    expect_orbit_near(orbit.camera().eye, orbit_start().eye,
                      4e-6F);  // the scale is float: 2e-7 of a turn, at distance 5
    EXPECT_LE(std::abs(orbit.yaw()), std::numbers::pi);
}

TEST(OrbitCamera, ZoomIsAFactorPerNotchHoweverSplit) {
    OrbitCamera together(orbit_start());
    OrbitCamera split(orbit_start());
    together.update({.scroll = 7.0F});
    for (int i = 0; i < 14; ++i) split.update({.scroll = 0.5F});
    EXPECT_NEAR(together.distance(), 5.0 * std::exp(-0.7), 1e-6);  // rounding
    EXPECT_NEAR(split.distance(), together.distance(), 1e-5F);     // 14 roundings
    together.update({.scroll = -7.0F});
    EXPECT_NEAR(together.distance(), 5.0F, 1e-6F);
}

TEST(OrbitCamera, ZoomStaysWithinItsLimits) {
    OrbitCamera orbit(orbit_start(), {.minimum_distance = 0.5F, .maximum_distance = 20.0F});
    orbit.update({.scroll = 1e6F});
    EXPECT_EQ(orbit.distance(), 0.5F);
    orbit.update({.scroll = -1e6F});
    EXPECT_EQ(orbit.distance(), 20.0F);
    orbit.update({.scroll = kLargest});
    EXPECT_EQ(orbit.distance(), 0.5F);
}

TEST(OrbitCamera, BrokenInputChangesNothing) {
    OrbitCamera orbit(orbit_start());
    for (const float broken : {kOrbitNaN, kOrbitInfinity, -kOrbitInfinity}) {
        orbit.update({.drag = {broken, broken}, .scroll = broken});
        expect_orbit_near(orbit.camera().eye, orbit_start().eye, 2e-6F);  // as at the start
    }
    orbit.update({.drag = {kLargest, -kLargest}, .scroll = -kLargest});
    expect_usable(orbit.camera());
}

TEST(OrbitCamera, StartWithoutADirectionIsUsable) {
    for (const glm::vec3 eye :
         {glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(kOrbitNaN), glm::vec3(kOrbitInfinity, 0.0F, 0.0F)}) {
        const OrbitCamera orbit({.eye = eye, .target = {1.0F, 0.0F, 0.0F}});
        EXPECT_GT(orbit.distance(), 0.0F);
        expect_usable(orbit.camera());
    }
    expect_usable(OrbitCamera({.eye = glm::vec3(0.0F), .target = glm::vec3(kOrbitNaN)}).camera());
    expect_usable(OrbitCamera({.eye = {0.0F, 9.0F, 0.0F}, .target = glm::vec3(0.0F)}).camera());  // from the pole
}

TEST(OrbitCameraDeathTest, RefusesADistanceOfZero) {
    EXPECT_DEATH(OrbitCamera(Camera{}, {.minimum_distance = 0.0F}), "minimum_distance > 0");
}

}  // namespace
}  // namespace rowland::scene
