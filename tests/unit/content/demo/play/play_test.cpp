#include "content/demo/play/play.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/unit/content/demo/play/small_world.h"

namespace rowland::demo {
namespace {

using platform::Key;
using test::drag;
using test::kBeside;
using test::key;
using test::kOnLeft;
using test::kOnRight;
using test::SmallWorld;
using test::tap;

constexpr std::size_t kLeft = 0;
constexpr std::size_t kRight = 1;

glm::vec3 normal_of(SmallWorld& small, ecs::Entity node) {
    return glm::normalize(glm::mat3(object_to_world(small.world, node)) * glm::vec3(0.0F, 0.0F, 1.0F));
}

/// Angle by which a body is turned from rest, radians.
double turned(const Play& play, std::size_t body) {
    const glm::dquat q = play.bodies()[body].state.turned;
    return 2.0 * std::atan2(glm::length(glm::dvec3(q.x, q.y, q.z)), std::abs(q.w));
}

TEST(DemoPlay, ADragTurnsWhatIsUnderItAndNothingElse) {
    SmallWorld small;
    Play play = small.play();
    const glm::vec3 eye = play.camera().eye;
    drag(play, kOnRight, {2.0, 0.0}, 10);
    EXPECT_EQ(play.held_body(), kRight);
    // The square's ball has a radius of 0.1 m, which is 40 points: 20 points are half a radian.
    EXPECT_NEAR(turned(play, kRight), 0.5, 1e-3);
    EXPECT_EQ(turned(play, kLeft), 0.0);
    EXPECT_EQ(play.camera().eye, eye);
    // The near side of the ball follows the cursor to the right: so does the normal.
    EXPECT_NEAR(glm::distance(normal_of(small, small.right), glm::vec3(std::sin(0.5), 0.0, std::cos(0.5))), 0.0, 2e-3);
}

TEST(DemoPlay, ADragThatEndsInItsLastStepLeavesTheCameraAlone) {
    SmallWorld small;
    Play play = small.play();
    const glm::vec3 eye = play.camera().eye;
    drag(play, kOnRight, {2.0, 0.0}, 10);
    const std::vector<PlayEvent> last = {test::mouse(kOnRight + glm::dvec2(24.0, 0.0)), test::button(false)};
    play.step(last);
    EXPECT_FALSE(play.held_body());
    EXPECT_EQ(play.camera().eye, eye);
    EXPECT_GT(turned(play, kRight), 0.55);
}

TEST(DemoPlay, ADragTurnsTheSameWayUnderATurnedParent) {
    SmallWorld small;
    Play play = small.play();
    tap(play, Key::Space);
    drag(play, kOnLeft, {0.0, -2.0}, 10);
    // Upwards: the normal leans up.
    EXPECT_NEAR(glm::distance(normal_of(small, small.left), glm::vec3(0.0, std::sin(0.5), std::cos(0.5))), 0.0, 2e-3);
}

TEST(DemoPlay, ADragBesideObjectsOrbits) {
    SmallWorld small;
    Play play = small.play();
    const glm::vec3 eye = play.camera().eye;
    drag(play, kBeside, {2.0, 0.0}, 10);
    EXPECT_FALSE(play.held_body());
    EXPECT_EQ(turned(play, kRight), 0.0);
    EXPECT_GT(glm::distance(play.camera().eye, eye), 0.05F);
}

TEST(DemoPlay, LetGoInMotionItTurnsOnAndSlowsDown) {
    SmallWorld small;
    Play play = small.play();
    drag(play, kOnRight, {2.0, 0.0}, 40);
    play.step(std::vector{test::button(false)});
    const double speed = glm::length(play.bodies()[kRight].state.spin);
    // 2 points a step are 2 / 40 of a radian in 1/120 s: 6 radians a second. The hand's speed is known to exp(-40 / 6).
    EXPECT_NEAR(speed, 6.0, 0.3);
    const double before = turned(play, kRight);
    test::wait(play, 12);
    EXPECT_GT(std::abs(turned(play, kRight) - before), 0.3);
    test::wait(play, 120);
    const double expected = speed * std::exp(-1.1 / kSpinDecay_s);
    EXPECT_NEAR(glm::length(play.bodies()[kRight].state.spin), expected, 0.02 * expected);
}

TEST(DemoPlay, HeldStillBeforeItIsLetGoItStays) {
    SmallWorld small;
    Play play = small.play();
    drag(play, kOnRight, {2.0, 0.0}, 40);
    test::wait(play, 60);
    play.step(std::vector{test::button(false)});
    const double before = turned(play, kRight);
    test::wait(play, 60);
    EXPECT_EQ(turned(play, kRight), before);
}

TEST(DemoPlay, TheWheelSpinsWhatIsHeldAboutItsOwnAxisAndElseZooms) {
    SmallWorld small;
    Play play = small.play();
    const float far = glm::length(play.camera().eye);
    play.step(std::vector{test::mouse(kOnLeft), test::button(true)});
    play.step(std::vector{test::wheel(1.0)});
    test::wait(play, 12);
    EXPECT_EQ(glm::length(play.camera().eye), far);
    EXPECT_GT(turned(play, kLeft), 0.1);
    EXPECT_NEAR(normal_of(small, small.left).z, 1.0F, 1e-5F);  // it turned about its normal
    play.step(std::vector{test::button(false)});
    play.step(std::vector{test::wheel(1.0)});
    EXPECT_LT(glm::length(play.camera().eye), 0.95F * far);
}

TEST(DemoPlay, ShiftAndDragTurnsAboutItsOwnAxisWithTheCursor) {
    SmallWorld small;
    Play play = small.play();
    tap(play, Key::Space);
    play.step(std::vector{key(Key::LeftShift, true)});
    // Taken 0.05 m (20 points) right of the middle and dragged up by 20 points: by about 45 degrees, as seen.
    const glm::dvec2 from = kOnLeft + glm::dvec2(20.0, 0.0);
    play.step(std::vector{test::mouse(from)});
    play.step(std::vector{test::button(true)});
    for (int i = 1; i <= 20; ++i) play.step(std::vector{test::mouse(from - glm::dvec2(0.0, i))});
    EXPECT_NEAR(normal_of(small, small.left).z, 1.0F, 1e-5F);
    // The point follows the drag's component along its circle: the integral of cos over the way, 1 = sin(angle).
    const double angle = turned(play, kLeft);
    EXPECT_GT(angle, 0.8);
    EXPECT_LT(angle, 1.6);
    EXPECT_FALSE(play.bodies()[kLeft].state.raised);
}

TEST(DemoPlay, ADragLiftsTheObjectAndPuttingBackRestoresIt) {
    SmallWorld small;
    Play play = small.play();
    const glm::mat4 before = object_to_world(small.world, small.right);
    drag(play, kOnRight, {2.0, 1.0}, 20);
    test::wait(play, 120);
    const glm::vec3 lifted = object_to_world(small.world, small.right)[3];
    EXPECT_NEAR(lifted.y - before[3].y, 0.05F, 1e-4F);
    play.step(std::vector{test::button(false)});
    tap(play, Key::R);
    EXPECT_EQ(object_to_world(small.world, small.right), before);
}

TEST(DemoPlay, PauseStopsWhatMovesByItselfButNotTheHand) {
    SmallWorld small;
    Play play = small.play();
    tap(play, Key::Space);
    ASSERT_TRUE(play.paused());
    const double time = play.time_s();
    const glm::mat4 before = object_to_world(small.world, small.left);
    test::wait(play, 60);
    EXPECT_EQ(play.time_s(), time);
    EXPECT_EQ(object_to_world(small.world, small.left), before);
    drag(play, kOnRight, {2.0, 0.0}, 10);
    EXPECT_GT(turned(play, kRight), 0.4);
    play.step(std::vector{test::button(false)});
    tap(play, Key::Space);
    test::wait(play, 60);
    EXPECT_NE(object_to_world(small.world, small.left), before);
}

TEST(DemoPlay, SlowMotionIsATenthAndOneStepAThirtieth) {
    SmallWorld small;
    Play play = small.play();
    tap(play, Key::M);
    const double slow = play.time_s();
    test::wait(play, 120);
    EXPECT_NEAR(play.time_s() - slow, 0.1, 1e-9);
    tap(play, Key::M);
    tap(play, Key::Space);
    const double paused = play.time_s();
    tap(play, Key::N);
    test::wait(play, 30);
    EXPECT_NEAR(play.time_s() - paused, 1.0 / 30.0, 1e-9);
    EXPECT_TRUE(play.paused());
}

TEST(DemoPlay, AHeldKeyRepeats) {
    SmallWorld small;
    Play play = small.play();
    play.step(std::vector{key(Key::Period, true)});
    const double once = play.environment_turn();
    test::wait(play, 40);
    EXPECT_EQ(play.environment_turn(), once);
    test::wait(play, 120);
    // 161 steps in all: after 48, one every 12.
    EXPECT_NEAR(play.environment_turn() / once, 10.0, 1e-6);
    play.step(std::vector{key(Key::Period, false)});
    tap(play, Key::Comma);
    EXPECT_NEAR(play.environment_turn() / once, 9.0, 1e-6);
}

TEST(DemoPlay, TurningTheEnvironmentTurnsEverythingElseTheOtherWay) {
    SmallWorld small;
    Play play = small.play();
    tap(play, Key::Space);
    const auto seen = [&](ecs::Entity entity) { return play.camera().view() * object_to_world(small.world, entity); };
    const glm::mat4 left = seen(small.left);
    const glm::mat4 right = seen(small.right);
    const glm::vec3 eye = play.camera().eye;
    for (int i = 0; i < 9; ++i) tap(play, Key::Comma);
    EXPECT_NEAR(play.environment_turn(), std::numbers::pi / 4.0, 1e-12);
    // The environment went round by +45 degrees about Y, so the eye at (0, 0, 1) went to (-sin, 0, cos).
    const float s = std::sqrt(0.5F);
    EXPECT_NEAR(glm::distance(play.camera().eye, glm::vec3(-s, 0.0F, s) * glm::length(eye)), 0.0F, 1e-5F);
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(glm::distance(seen(small.left)[i], left[i]), 0.0F, 1e-5F);
        EXPECT_NEAR(glm::distance(seen(small.right)[i], right[i]), 0.0F, 1e-5F);
    }
    // And what is under the cursor still is, and a new light comes before it.
    const auto hit = play.hit_at(kOnRight);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->target, 1U);
    play.step(std::vector{test::mouse(kOnRight)});
    tap(play, Key::G);
    EXPECT_LT(glm::distance(glm::vec3(object_to_world(small.world, play.lights().entities()[0])[3]), hit->point), 0.5F);
}

TEST(DemoPlay, AHeldKeyAddsOneLight) {
    SmallWorld small;
    Play play = small.play();
    play.step(std::vector{test::key(Key::G, true)});
    test::wait(play, 500);
    play.step(std::vector{test::key(Key::G, false)});
    EXPECT_EQ(play.lights().entities().size(), 1U);
}

TEST(DemoPlay, LightsAreAddedBeforeWhatIsUnderTheCursorUpToTheMost) {
    SmallWorld small;
    const ecs::Entity lamp = small.world.create();
    small.world.add(lamp, scene::DirectionalLight{});
    Play play = small.play();
    play.step(std::vector{test::mouse(kOnRight)});
    tap(play, Key::G);
    ASSERT_EQ(light_count(small.world), 2U);
    const glm::vec3 position = object_to_world(small.world, play.lights().entities()[0])[3];
    EXPECT_GT(position.z, 0.1F);
    EXPECT_LT(glm::distance(position, glm::vec3(0.15F, 0.0F, 0.0F)), 0.5F);
    for (int i = 0; i < 70; ++i) tap(play, Key::G);
    EXPECT_EQ(light_count(small.world), kMostLights);
    EXPECT_EQ(play.lights().entities().size(), kMostLights - 1);
    tap(play, Key::Backspace);
    EXPECT_EQ(light_count(small.world), kMostLights - 1);
    for (int i = 0; i < 70; ++i) tap(play, Key::Backspace);
    EXPECT_EQ(light_count(small.world), 1U);
}

TEST(DemoPlay, AWalkerStaysInTheRoomAndEscapeEndsTheWalkFirst) {
    SmallWorld small;
    Play play = small.play();
    tap(play, Key::C);
    ASSERT_TRUE(play.walking());
    const glm::vec3 start = play.camera().eye;
    play.step(std::vector{key(Key::W, true), key(Key::LeftShift, true)});
    test::wait(play, 240);
    EXPECT_NE(play.camera().eye, start);
    play.step(std::vector{key(Key::Q, true)});
    test::wait(play, 1200);
    EXPECT_EQ(play.camera().eye.y, -1.0F);
    EXPECT_EQ(play.camera().eye.z, -2.0F);
    tap(play, Key::Escape);
    EXPECT_FALSE(play.walking());
    EXPECT_TRUE(play.take_commands().empty());
    tap(play, Key::Escape);
    EXPECT_EQ(play.take_commands(), std::vector<Play::Command>{Action::Close});
}

TEST(DemoPlay, AWalkerStopsBeforeAnObjectAndWalksOnBesideIt) {
    SmallWorld small;
    Play play = small.play();
    tap(play, Key::C);
    play.step(std::vector{key(Key::D, true)});
    while (play.camera().eye.x < 0.15F) play.step({});
    play.step(std::vector{key(Key::D, false)});
    test::wait(play, 120);
    play.step(std::vector{key(Key::W, true)});
    test::wait(play, 600);
    const float stopped = play.camera().eye.z;
    EXPECT_GT(stopped, 0.0F);
    EXPECT_LT(stopped, 0.1F);
    play.step(std::vector{key(Key::D, true)});
    test::wait(play, 1200);
    EXPECT_LT(play.camera().eye.z, 0.0F);
}

TEST(DemoPlay, TheViewStaysWhereTheWalkEnded) {
    SmallWorld small;
    Play play = small.play();
    tap(play, Key::C);
    play.step(std::vector{key(Key::D, true)});
    test::wait(play, 30);
    play.step(std::vector{key(Key::D, false)});
    test::wait(play, 120);
    const scene::Camera walked = play.camera();
    tap(play, Key::C);
    EXPECT_NEAR(glm::distance(play.camera().eye, walked.eye), 0.0F, 1e-4F);
    tap(play, Key::Home);
    EXPECT_NEAR(glm::distance(play.camera().eye, glm::vec3(0.0F, 0.0F, 1.0F)), 0.0F, 1e-5F);
}

TEST(DemoPlay, AWalkerGrabsWhatHeLooksAt) {
    SmallWorld small;
    Play play = small.play();
    // To the right until the right square lies ahead.
    tap(play, Key::C);
    play.step(std::vector{key(Key::D, true)});
    while (play.camera().eye.x < 0.1F) play.step({});
    play.step(std::vector{key(Key::D, false)});
    test::wait(play, 120);
    play.step(std::vector{test::mouse({5.0, 5.0}), test::button(true)});
    EXPECT_EQ(play.held_body(), kRight);
    const glm::vec3 ahead = play.camera().target - play.camera().eye;
    play.step(std::vector{test::mouse({25.0, 5.0})});
    EXPECT_GT(turned(play, kRight), 0.3);
    EXPECT_EQ(play.camera().target - play.camera().eye, ahead);
}

TEST(DemoPlay, TheGamePadOrbitsAndGrabsTheMiddle) {
    SmallWorld small;
    Play play = small.play();
    platform::GamepadEvent pad{.connected = true, .axes = {}, .buttons = {}};
    pad.axes[static_cast<std::size_t>(platform::GamepadAxis::RightX)] = 1.0F;
    const glm::vec3 eye = play.camera().eye;
    play.step(std::vector<PlayEvent>{platform::InputEvent(pad)});
    test::wait(play, 10);
    EXPECT_GT(glm::distance(play.camera().eye, eye), 0.01F);
    pad.axes = {};
    pad.buttons[static_cast<std::size_t>(platform::GamepadButton::Start)] = true;
    play.step(std::vector<PlayEvent>{platform::InputEvent(pad)});
    EXPECT_TRUE(play.paused());
}

TEST(DemoPlay, AnActionChosenInAMenuIsAsGoodAsItsKey) {
    SmallWorld small;
    Play play = small.play();
    play.step(std::vector<PlayEvent>{ActionEvent{Action::Pause}, ActionEvent{Action::NextProbe}});
    EXPECT_TRUE(play.paused());
    EXPECT_EQ(play.take_commands(), std::vector<Play::Command>{Action::NextProbe});
    EXPECT_TRUE(play.take_commands().empty());
}

TEST(DemoPlay, ASceneLoadedAnewKeepsWhatItsObjectsBecame) {
    SmallWorld small;
    Play play = small.play();
    drag(play, kOnRight, {2.0, 1.0}, 20);
    play.step(std::vector{test::button(false)});
    test::wait(play, 30);
    const BodyState before = play.bodies()[kRight].state;
    ASSERT_GT(glm::length(before.spin), 1.0);
    const glm::mat4 stood = object_to_world(small.world, small.right);
    play.move_to_rest_pose();
    EXPECT_NE(object_to_world(small.world, small.right), stood);
    Toys toys = small.toys();
    std::swap(toys.bodies[0], toys.bodies[1]);
    toys.body_of_target = {1, 0};
    play.set_toys(toys);
    EXPECT_EQ(play.bodies()[0].name, "right");
    EXPECT_EQ(play.bodies()[0].state, before);
    EXPECT_EQ(object_to_world(small.world, small.right), stood);
}

}  // namespace
}  // namespace rowland::demo
