#include "engine/scene/camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "tests/support/expect.h"

namespace rowland::scene {
namespace {

using rowland::test::expect_near;

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

/// At the origin, looking along -Z, so that +X is to the right.
Camera start() {
    return {.eye = glm::vec3(0.0F), .target = {0.0F, 0.0F, -1.0F}, .far_plane = 77.0F};
}

/// The camera after `seconds` of `input` in `frames` frames; the mouse movement is spread over them.
FlyCamera flown(FlyInput input, double seconds, int frames, FlyCamera camera = FlyCamera(start())) {
    input.look /= static_cast<float>(frames);
    for (int i = 0; i < frames; ++i) camera.update(input, seconds / frames);
    return camera;
}

TEST(FlyCamera, StartsAtTheGivenCamera) {
    const Camera given{.eye = {1.0F, 2.0F, 3.0F}, .target = {4.0F, 2.5F, -3.0F}, .far_plane = 77.0F};
    const Camera camera = FlyCamera(given).camera();
    EXPECT_EQ(camera.eye, given.eye);
    EXPECT_EQ(camera.far_plane, 77.0F);
    // Rounding of the angles, and of the sum at coordinates of 3.
    expect_near(camera.target - camera.eye, glm::normalize(given.target - given.eye), 1e-6F);
}

TEST(FlyCamera, MovesAlongItsOwnAxes) {
    const auto heading = [](glm::vec3 move) { return glm::normalize(flown({.move = move}, 1.0, 1).position()); };
    expect_near(heading({0.0F, 0.0F, 1.0F}), {0.0F, 0.0F, -1.0F}, 1e-6F);  // rounding
    expect_near(heading({1.0F, 0.0F, 0.0F}), {1.0F, 0.0F, 0.0F}, 1e-6F);
    expect_near(heading({0.0F, 1.0F, 0.0F}), {0.0F, 1.0F, 0.0F}, 1e-6F);
}

TEST(FlyCamera, UpIsTheWorldsUpWhereverItLooks) {
    FlyCamera camera(start());
    camera.update({.look = {0.0F, -300.0F}}, 0.0);
    EXPECT_GT(camera.pitch(), 0.5);
    expect_near(glm::normalize(flown({.move = {0.0F, 1.0F, 0.0F}}, 1.0, 1, camera).position()), {0.0F, 1.0F, 0.0F},
                1e-6F);  // rounding
}

TEST(FlyCamera, MouseToTheRightLooksRightAndDownLooksDown) {
    FlyCamera camera(start());
    camera.update({.look = {100.0F, 0.0F}}, 0.01);
    EXPECT_GT(camera.camera().target.x, 0.1F);
    camera.update({.look = {0.0F, 100.0F}}, 0.01);
    EXPECT_LT(camera.camera().target.y, -0.1F);
}

TEST(FlyCamera, StickTurnsToItsSide) {
    EXPECT_GT(flown({.turn = {1.0F, 0.0F}}, 0.2, 1).camera().target.x, 0.1F);
    EXPECT_GT(flown({.turn = {0.0F, 1.0F}}, 0.2, 1).camera().target.y, 0.1F);
}

TEST(FlyCamera, WayDoesNotDependOnTheFrameRate) {
    const FlyInput input{.move = {0.5F, 0.2F, 0.7F}};
    const FlyInput rest;
    const FlyCamera one = flown(rest, 0.3, 1, flown(input, 2.0, 1));
    for (const int frames : {2, 30, 60, 144, 1000}) {
        const FlyCamera many = flown(rest, 0.3, frames, flown(input, 2.0, frames));
        // The solution is exact; the position is kept in double and shown in float.
        expect_near(many.position(), one.position(), 1e-6F);
        expect_near(many.velocity(), one.velocity(), 1e-6F);
    }
}

TEST(FlyCamera, ViewDoesNotDependOnTheFrameRate) {
    const FlyInput input{.look = {200.0F, -90.0F}, .turn = {0.4F, 0.3F}};
    const FlyCamera one = flown(input, 1.0, 1);
    const FlyCamera many = flown(input, 1.0, 100);
    EXPECT_NEAR(many.yaw(), one.yaw(), 1e-6);  // the mouse movement of a frame is float
    EXPECT_NEAR(many.pitch(), one.pitch(), 1e-6);
}

TEST(FlyCamera, WayOnACurveConvergesToSecondOrder) {
    // Two radians to the right in a second, by stick and by mouse.
    for (const FlyInput& input : {FlyInput{.move = {0.0F, 0.0F, 1.0F}, .turn = {1.0F, 0.0F}},
                                  FlyInput{.move = {0.0F, 0.0F, 1.0F}, .look = {2.0F / 0.003F, 0.0F}}}) {
        const glm::vec3 exact = flown(input, 1.0, 10000).position();
        const float at_30 = glm::distance(flown(input, 1.0, 30).position(), exact);
        const float at_60 = glm::distance(flown(input, 1.0, 60).position(), exact);
        EXPECT_LT(at_30, 0.001F);  // a millimetre of a metre: (2 rad/s / 30 s)^2 / 24 and the easing's error
        EXPECT_NEAR(at_30 / at_60, 4.0F, 0.4F);  // order 2; the tenth is the next order's
    }
}

TEST(FlyCamera, ReachesItsSpeedAndComesToRest) {
    FlySettings settings;
    settings.speed_m_per_s = 3.0F;
    FlyCamera camera = flown({.move = {0.0F, 0.0F, 1.0F}}, 2.0, 100, FlyCamera(start(), settings));
    EXPECT_NEAR(glm::length(camera.velocity()), 3.0F, 1e-6F);  // 2 s are 33 time constants
    camera = flown({}, 2.0, 100, camera);
    EXPECT_NEAR(glm::length(camera.velocity()), 0.0F, 1e-6F);
}

TEST(FlyCamera, TwoKeysAreNotFasterThanOne) {
    const FlyCamera camera = flown({.move = {1.0F, 1.0F, 1.0F}}, 2.0, 1);
    EXPECT_NEAR(glm::length(camera.velocity()), 1.0F, 1e-6F);  // rounding
    const FlyCamera slow = flown({.move = {0.0F, 0.0F, 0.3F}}, 2.0, 1);
    EXPECT_NEAR(glm::length(slow.velocity()), 0.3F, 1e-6F);  // but a stick may ask for less
}

TEST(FlyCamera, FastAndSlowAreFactorsAndCancelInTheirProduct) {
    const auto speed = [](bool fast, bool slow) {
        return glm::length(flown({.move = {0.0F, 0.0F, 1.0F}, .fast = fast, .slow = slow}, 2.0, 1).velocity());
    };
    EXPECT_NEAR(speed(true, false), 4.0F, 1e-5F);  // rounding
    EXPECT_NEAR(speed(false, true), 0.25F, 1e-6F);
    EXPECT_NEAR(speed(true, true), 1.0F, 1e-6F);
}

TEST(FlyCamera, PitchEndsShortOfThePoles) {
    for (const float way : {1.0F, -1.0F}) {
        const FlyCamera camera = flown({.look = {0.0F, -way * 1e6F}}, 0.1, 1);
        EXPECT_EQ(camera.pitch(), static_cast<double>(way) * kMaximumPitch);
        const FlyCamera forward = flown({.move = {1.0F, 0.0F, 0.0F}}, 1.0, 1, camera);
        EXPECT_GT(forward.position().x, 0.5F);  // there is still a right
    }
}

TEST(FlyCamera, BrokenInputAndTimeChangeNothing) {
    FlyCamera camera = flown({.move = {0.0F, 0.0F, 1.0F}}, 1.0, 1);
    const glm::vec3 position = camera.position();
    for (const float broken : {kNotANumber, kInfinite, -kInfinite}) {
        camera.update({.move = {broken, 0.0F, 0.0F}, .look = glm::vec2(broken), .turn = glm::vec2(broken)}, 0.0);
        camera.update({.move = {0.0F, 0.0F, 1.0F}, .turn = {1.0F, 1.0F}}, static_cast<double>(broken));
    }
    camera.update({.move = {0.0F, 0.0F, 1.0F}}, -1.0);
    EXPECT_EQ(camera.position(), position);
    const Camera shown = FlyCamera({.eye = glm::vec3(kNotANumber), .target = glm::vec3(kNotANumber)}).camera();
    EXPECT_TRUE(std::isfinite(shown.view()[3][0]));
}

TEST(FlyCamera, StopsAtTheWallsOfItsRoomAndSlidesAlongThem) {
    FlySettings settings;
    settings.room = Bounds{{-1.0F, -0.5F, -1.0F}, {1.0F, 0.5F, 1.0F}};
    FlyCamera camera(start(), settings);
    // Down and forward: the floor stops the one, and the other goes on as fast.
    for (int i = 0; i < 120; ++i) camera.update({.move = {0.0F, -1.0F, 0.5F}}, 1.0 / 60.0);
    EXPECT_EQ(camera.position().y, -0.5F);
    EXPECT_EQ(camera.velocity().y, 0.0F);
    EXPECT_LT(camera.velocity().z, -0.4F);
    for (int i = 0; i < 600; ++i) camera.update({.move = {0.0F, -1.0F, 0.5F}}, 1.0 / 60.0);
    EXPECT_EQ(camera.position().y, -0.5F);
    EXPECT_EQ(camera.position().z, -1.0F);
}

constexpr float kLargest = std::numeric_limits<float>::max();

Camera orbit_start() {
    return {.eye = {1.0F, 3.0F, 4.0F}, .target = {1.0F, 0.0F, 0.0F}, .vertical_field_of_view = 0.5F};
}

float distance_of(const Camera& camera) {
    return glm::distance(camera.eye, camera.target);
}

void expect_usable(const Camera& camera) {
    const glm::mat4 view = camera.view();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) ASSERT_TRUE(std::isfinite(view[column][row]));
}

TEST(OrbitCamera, StartsAtTheGivenCamera) {
    const Camera camera = OrbitCamera(orbit_start()).camera();
    expect_near(camera.eye, orbit_start().eye, 2e-6F);  // rounding of the angles at distance 5
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
    expect_near(orbit.camera().eye, orbit_start().eye,
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
    for (const float broken : {kNotANumber, kInfinite, -kInfinite}) {
        orbit.update({.drag = {broken, broken}, .scroll = broken});
        expect_near(orbit.camera().eye, orbit_start().eye, 2e-6F);  // as at the start
    }
    orbit.update({.drag = {kLargest, -kLargest}, .scroll = -kLargest});
    expect_usable(orbit.camera());
}

TEST(OrbitCamera, StartWithoutADirectionIsUsable) {
    for (const glm::vec3 eye :
         {glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(kNotANumber), glm::vec3(kInfinite, 0.0F, 0.0F)}) {
        const OrbitCamera orbit({.eye = eye, .target = {1.0F, 0.0F, 0.0F}});
        EXPECT_GT(orbit.distance(), 0.0F);
        expect_usable(orbit.camera());
    }
    expect_usable(OrbitCamera({.eye = glm::vec3(0.0F), .target = glm::vec3(kNotANumber)}).camera());
    expect_usable(OrbitCamera({.eye = {0.0F, 9.0F, 0.0F}, .target = glm::vec3(0.0F)}).camera());  // from the pole
}

}  // namespace
}  // namespace rowland::scene
