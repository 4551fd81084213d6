#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "engine/platform/input.h"
#include "engine/platform/window.h"

namespace rowland::platform {

namespace {

constexpr ButtonState kUp{};
constexpr ButtonState kWentDown{.down = true, .pressed = true, .released = false};
constexpr ButtonState kHeld{.down = true, .pressed = false, .released = false};
constexpr ButtonState kWentUp{.down = false, .pressed = false, .released = true};
constexpr ButtonState kTapped{.down = false, .pressed = true, .released = true};

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

GamepadEvent pad_with(GamepadAxis axis, float value) {
    GamepadEvent event{.connected = true, .axes = {}, .buttons = {}};
    event.axes[static_cast<std::size_t>(axis)] = value;
    return event;
}

TEST(Input, AKeysStateFollowsItsEventsOfEachFrame) {
    struct Frame {
        std::vector<bool> downs;
        ButtonState state;
    };
    const std::vector<std::vector<Frame>> plays = {
        {{{true}, kWentDown}, {{}, kHeld}, {{false}, kWentUp}, {{}, kUp}},
        {{{true, false}, kTapped}, {{}, kUp}},
        {{{true}, kWentDown}, {{false, true}, {.down = true, .pressed = true, .released = true}}},
        {{{true}, kWentDown}, {{true}, kHeld}},  // the keyboard's repeat
        {{{false}, kUp}},                        // a stray release
    };
    for (const std::vector<Frame>& play : plays) {
        InputState input;
        for (const Frame& frame : play) {
            input.begin_frame();
            for (const bool down : frame.downs) input.apply(KeyEvent{Key::W, down});
            EXPECT_EQ(input.key(Key::W), frame.state) << &play - plays.data();
            EXPECT_EQ(input.key(Key::S), kUp);
        }
    }
}

TEST(Input, AFrameEndsWhereAModifierChangesAfterAPress) {
    const InputEvent control{KeyEvent{Key::LeftControl, true}};
    const InputEvent no_control{KeyEvent{Key::LeftControl, false}};
    const InputEvent a{KeyEvent{Key::A, true}};
    const InputEvent no_a{KeyEvent{Key::A, false}};
    const InputEvent click{MouseButtonEvent{MouseButton::Left, true}};
    const InputEvent unfocused{FocusEvent{false}};
    const std::vector<std::pair<std::vector<InputEvent>, std::size_t>> cases = {
        {{}, 0},
        {{control, a, no_a}, 3},
        {{control, a, no_a, no_control, a}, 3},
        {{a, no_a, control, a}, 2},
        {{no_a, no_control, a, CharEvent{U'a'}}, 4},
        {{control, no_control, control, click, MouseMoveEvent{{1.0, 1.0}}, no_control}, 5},
        {{a, unfocused}, 1},
        {{unfocused, a}, 2},
    };
    for (const auto& [events, count] : cases)
        EXPECT_EQ(events_of_one_frame(events), count) << "of " << events.size() << " events";
}

TEST(Input, KeyAxisCountsTapsAndCancelsOpposites) {
    InputState input;
    EXPECT_EQ(input.key_axis(Key::A, Key::D), 0.0F);
    input.apply(KeyEvent{Key::D, true});
    EXPECT_EQ(input.key_axis(Key::A, Key::D), 1.0F);
    EXPECT_EQ(input.key_axis(Key::D, Key::A), -1.0F);
    input.apply(KeyEvent{Key::A, true});
    EXPECT_EQ(input.key_axis(Key::A, Key::D), 0.0F);
    input.begin_frame();
    input.apply(KeyEvent{Key::A, false});
    EXPECT_EQ(input.key_axis(Key::A, Key::D), 1.0F);
    input.apply(KeyEvent{Key::D, false});
    input.begin_frame();
    input.apply(KeyEvent{Key::A, true});
    input.apply(KeyEvent{Key::A, false});
    EXPECT_EQ(input.key_axis(Key::A, Key::D), -1.0F);
}

TEST(Input, DeltaSumsTheMovementsOfOneFrameWithoutJumps) {
    InputState input;
    input.apply(MouseMoveEvent{{10.0, 10.0}});
    EXPECT_EQ(input.mouse_delta(), glm::dvec2(0.0));  // the first movement
    EXPECT_EQ(input.mouse_position(), glm::dvec2(10.0, 10.0));
    input.begin_frame();
    input.apply(MouseMoveEvent{{15.0, 9.0}});
    input.apply(MouseMoveEvent{{12.0, 20.0}});
    EXPECT_EQ(input.mouse_delta(), glm::dvec2(2.0, 10.0));
    input.begin_frame();
    input.apply(FocusEvent{false});
    input.apply(FocusEvent{true});
    input.apply(MouseMoveEvent{{900.0, 900.0}});  // after a change of focus
    EXPECT_EQ(input.mouse_delta(), glm::dvec2(0.0));
}

TEST(Input, CaptureMakesNoJumpWhenItBeginsOrEnds) {
    InputState input;
    input.apply(MouseMoveEvent{{10.0, 10.0}});
    for (const bool captured : {true, false}) {
        input.begin_frame();
        input.apply(CursorCaptureEvent{captured});
        input.apply(MouseMoveEvent{{captured ? 5000.0 : -5000.0, 77.0}});
        EXPECT_EQ(input.mouse_delta(), glm::dvec2(0.0)) << "captured: " << captured;
        input.apply(MouseMoveEvent{{captured ? 5003.0 : -4997.0, 76.0}});
        EXPECT_EQ(input.mouse_delta(), glm::dvec2(3.0, -1.0)) << "captured: " << captured;
    }
}

TEST(Input, DragIsOnlyTheMovementWithTheButtonDown) {
    InputState input;
    input.apply(MouseMoveEvent{{0.0, 0.0}});
    input.apply(MouseMoveEvent{{100.0, 0.0}});
    input.apply(MouseButtonEvent{MouseButton::Left, true});
    input.apply(MouseMoveEvent{{107.0, 5.0}});
    input.apply(MouseButtonEvent{MouseButton::Left, false});
    input.apply(MouseMoveEvent{{300.0, 300.0}});
    EXPECT_EQ(input.mouse_drag(MouseButton::Left), glm::dvec2(7.0, 5.0));
    EXPECT_EQ(input.mouse_drag(MouseButton::Right), glm::dvec2(0.0));
    EXPECT_EQ(input.mouse_delta(), glm::dvec2(300.0, 300.0));
    EXPECT_EQ(input.mouse_button(MouseButton::Left), kTapped);
    input.begin_frame();
    EXPECT_EQ(input.mouse_drag(MouseButton::Left), glm::dvec2(0.0));
}

TEST(Input, ScrollSumsWithinOneFrame) {
    InputState input;
    input.apply(ScrollEvent{{0.0, 1.0}});
    input.apply(ScrollEvent{{0.5, 1.0}});
    EXPECT_EQ(input.scroll(), glm::dvec2(0.5, 2.0));
    input.begin_frame();
    EXPECT_EQ(input.scroll(), glm::dvec2(0.0));
}

TEST(Input, NonFiniteMovementAndScrollAreIgnored) {
    InputState input;
    input.apply(MouseMoveEvent{{1.0, 1.0}});
    input.apply(MouseMoveEvent{{kNaN, 1.0}});
    input.apply(MouseMoveEvent{{1.0, kInfinity}});
    input.apply(ScrollEvent{{0.0, kNaN}});
    input.apply(MouseMoveEvent{{4.0, 1.0}});
    EXPECT_EQ(input.mouse_delta(), glm::dvec2(3.0, 0.0));
    EXPECT_EQ(input.scroll(), glm::dvec2(0.0));
}

TEST(Input, APressIsRememberedWhereItWasMade) {
    InputState input;
    input.apply(MouseMoveEvent{{10.0, 20.0}});
    input.apply(MouseButtonEvent{MouseButton::Left, true});
    input.apply(MouseMoveEvent{{90.0, 5.0}});
    input.apply(MouseButtonEvent{MouseButton::Left, false});
    EXPECT_EQ(input.press_position(MouseButton::Left), glm::dvec2(10.0, 20.0));
    EXPECT_EQ(input.press_position(MouseButton::Right), glm::dvec2(0.0));
}

TEST(Input, TypedTextIsThatOfOneFrameInOrder) {
    InputState input;
    input.apply(CharEvent{U'7'});
    input.apply(CharEvent{U'\u03BB'});
    EXPECT_EQ(input.typed(), U"7\u03BB");
    input.begin_frame();
    EXPECT_EQ(input.typed(), U"");
}

TEST(Input, WhatIsNoTextIsNotTyped) {
    InputState input;
    for (const char32_t c :
         {char32_t{0}, U'\n', char32_t{0x7F}, char32_t{0x9F}, char32_t{0xD800}, char32_t{0xDFFF}, char32_t{0x110000}})
        input.apply(CharEvent{c});
    EXPECT_EQ(input.typed(), U"");
    input.apply(CharEvent{U'\u00A0'});
    EXPECT_EQ(input.typed().size(), 1U);
}

TEST(Input, LosingTheFocusReleasesEverything) {
    InputState input;
    input.apply(KeyEvent{Key::W, true});
    input.apply(MouseButtonEvent{MouseButton::Right, true});
    GamepadEvent pad = pad_with(GamepadAxis::LeftX, 1.0F);
    pad.buttons[static_cast<std::size_t>(GamepadButton::South)] = true;
    input.apply(pad);
    input.begin_frame();
    input.apply(FocusEvent{false});
    EXPECT_FALSE(input.focused());
    EXPECT_EQ(input.key(Key::W), kWentUp);
    EXPECT_EQ(input.key(Key::S), kUp);
    EXPECT_EQ(input.mouse_button(MouseButton::Right), kWentUp);
    EXPECT_EQ(input.gamepad_button(GamepadButton::South), kWentUp);
    EXPECT_EQ(input.left_stick(), glm::vec2(0.0F));
    input.begin_frame();
    input.apply(KeyEvent{Key::W, false});  // the system's own release, late
    EXPECT_EQ(input.key(Key::W), kUp);
}

TEST(Input, GamepadRestsUntilTheFocusIsBack) {
    InputState input;
    input.apply(FocusEvent{false});
    input.apply(pad_with(GamepadAxis::LeftX, 1.0F));
    EXPECT_EQ(input.left_stick(), glm::vec2(0.0F));
    input.apply(FocusEvent{true});
    input.apply(pad_with(GamepadAxis::LeftX, 1.0F));
    EXPECT_EQ(input.left_stick(), glm::vec2(1.0F, 0.0F));
}

TEST(Input, UnpluggedGamepadIsReleased) {
    InputState input;
    GamepadEvent pad = pad_with(GamepadAxis::RightY, -1.0F);
    pad.buttons[static_cast<std::size_t>(GamepadButton::Start)] = true;
    input.apply(pad);
    EXPECT_EQ(input.gamepad_button(GamepadButton::Start), kWentDown);
    input.begin_frame();
    pad.connected = false;  // what it still reads is not to be trusted
    input.apply(pad);
    EXPECT_EQ(input.gamepad_button(GamepadButton::Start), kWentUp);
    EXPECT_EQ(input.right_stick(), glm::vec2(0.0F));
}

TEST(DeadZone, IsRoundAndStartsAtZeroOnItsEdge) {
    for (int degrees = 0; degrees < 360; degrees += 15) {
        const float angle = static_cast<float>(degrees) * std::numbers::pi_v<float> / 180.0F;
        const glm::vec2 direction{std::cos(angle), std::sin(angle)};
        // 1e-6: rounding of the direction's length around the edge.
        EXPECT_EQ(radial_dead_zone(direction * (kStickDeadZone - 1e-6F)), glm::vec2(0.0F)) << degrees;
        const float just_outside = glm::length(radial_dead_zone(direction * (kStickDeadZone + 0.001F)));
        EXPECT_GT(just_outside, 0.0F) << degrees;
        EXPECT_LT(just_outside, 0.0013F) << degrees;  // 0.001 / 0.85, and rounding: no step at the edge
    }
}

TEST(DeadZone, ReachesOneAtFullTravelAndNeverMore) {
    EXPECT_EQ(radial_dead_zone({1.0F, 0.0F}), glm::vec2(1.0F, 0.0F));
    EXPECT_EQ(radial_dead_zone({0.0F, -1.0F}), glm::vec2(0.0F, -1.0F));
    const glm::vec2 corner = radial_dead_zone({1.0F, 1.0F});  // square gates reach length 1.41
    EXPECT_NEAR(glm::length(corner), 1.0F, 1e-6F);            // rounding
    EXPECT_EQ(corner.x, corner.y);
}

TEST(DeadZone, IsLinearBetweenEdgeAndFullTravelAndKeepsTheDirection) {
    // Half way between 0.15 and 1, along a 3-4-5 direction.
    const glm::vec2 half = radial_dead_zone(glm::vec2(0.6F, -0.8F) * 0.575F);
    EXPECT_NEAR(half.x, 0.3F, 1e-6F);  // rounding
    EXPECT_NEAR(half.y, -0.4F, 1e-6F);
}

TEST(DeadZone, BrokenReadingIsRest) {
    EXPECT_EQ(radial_dead_zone({kNaN, 0.5F}), glm::vec2(0.0F));
    EXPECT_EQ(radial_dead_zone({0.5F, kInfinity}), glm::vec2(0.0F));
}

// A primary monitor, a larger one to its right and one that stands above, in negative coordinates.
const std::array kMonitors{ScreenArea{{0, 0}, {1920, 1080}}, ScreenArea{{1920, 0}, {2560, 1440}},
                           ScreenArea{{0, -1080}, {1920, 1080}}};

TEST(ScreenLayout, WindowBelongsToTheMonitorThatShowsMostOfIt) {
    const std::pair<ScreenArea, std::size_t> windows[] = {
        {{{100, 100}, {800, 600}}, 0},  {{{1900, 100}, {800, 600}}, 1},
        {{{1500, 100}, {800, 600}}, 0},                                     // 420 columns of it against 380
        {{{1540, 100}, {800, 600}}, 1},                                     // 380 against 420
        {{{1520, 100}, {800, 600}}, 0},                                     // equal: the first
        {{{100, -500}, {800, 600}}, 2}, {{{-5000, -5000}, {800, 600}}, 0},  // unseen: the primary one
        {{{100, 100}, {0, 0}}, 0}};
    for (const auto& [window, monitor] : windows)
        EXPECT_EQ(monitor_showing(window, kMonitors), monitor) << window.position.x << " " << window.position.y;
}

TEST(GlfwEvents, EveryNamedKeyHasAKeyOfTheKeyboard) {
    std::set<Key> reached;
    for (int key = -1; key <= GLFW_KEY_LAST; ++key)
        if (const auto known = key_of_glfw(key)) reached.insert(*known);
    EXPECT_EQ(reached.size(), static_cast<std::size_t>(Key::Count));
    EXPECT_FALSE(reached.contains(Key::Count));
}

TEST(GlfwEvents, KeysAndButtonsAreThemselvesAndOthersNothing) {
    const std::pair<int, std::optional<Key>> keys[] = {{GLFW_KEY_A, Key::A},      {GLFW_KEY_W, Key::W},
                                                       {GLFW_KEY_Z, Key::Z},      {GLFW_KEY_0, Key::Digit0},
                                                       {GLFW_KEY_9, Key::Digit9}, {GLFW_KEY_F1, Key::F1},
                                                       {GLFW_KEY_F12, Key::F12},  {GLFW_KEY_LEFT_SHIFT, Key::LeftShift},
                                                       {GLFW_KEY_UNKNOWN, {}},    {GLFW_KEY_F25, {}},
                                                       {GLFW_KEY_LAST + 1, {}}};
    for (const auto& [glfw, key] : keys) EXPECT_EQ(key_of_glfw(glfw), key) << glfw;
    EXPECT_EQ(mouse_button_of_glfw(GLFW_MOUSE_BUTTON_LEFT), MouseButton::Left);
    EXPECT_EQ(mouse_button_of_glfw(GLFW_MOUSE_BUTTON_RIGHT), MouseButton::Right);
    EXPECT_EQ(mouse_button_of_glfw(GLFW_MOUSE_BUTTON_MIDDLE), MouseButton::Middle);
    EXPECT_EQ(mouse_button_of_glfw(GLFW_MOUSE_BUTTON_8), std::nullopt);
}

}  // namespace

}  // namespace rowland::platform
