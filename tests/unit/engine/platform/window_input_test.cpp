// Needs a display (on_virtual_display.cpp) and xdotool, which moves the pointer and the keys as the server's own
// devices do.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>

#include "engine/platform/window.h"

namespace rowland::platform {
namespace {

using namespace std::chrono_literals;

/// What the user did over many polls.
class WindowInput : public testing::Test {
 protected:
    void SetUp() override {
        window_.set_position({100, 100});
        ASSERT_TRUE(poll_until([&] { return window_.focused() && window_.position() == glm::ivec2(100, 100); }));
    }

    void poll() {
        window_.poll(input_);
        moved_ += input_.mouse_delta();
        dragged_ += input_.mouse_drag(MouseButton::Left);
    }

    /// False if it takes longer than a display server ever needs.
    bool poll_until(const std::function<bool()>& done) {
        const auto deadline = std::chrono::steady_clock::now() + 10s;
        do {
            if (std::chrono::steady_clock::now() > deadline) return false;
            poll();
            if (done()) return true;
            std::this_thread::sleep_for(2ms);
        } while (true);
    }

    /// Polls until what the server had under way has come.
    void settle() {
        for (int i = 0; i < 50; ++i) {
            poll();
            std::this_thread::sleep_for(2ms);
        }
    }

    static void act(const std::string& arguments) {
        ASSERT_EQ(std::system(("xdotool " + arguments).c_str()), 0) << arguments;
    }

    Window window_{{.title = "test", .size = {400, 300}}};
    InputState input_;
    glm::dvec2 moved_{0.0};
    glm::dvec2 dragged_{0.0};
};

TEST_F(WindowInput, KeyTappedBetweenTwoPollsIsPressedAndReleased) {
    act("key w");
    ASSERT_TRUE(poll_until([&] { return input_.key(Key::W).pressed; }));
    EXPECT_TRUE(input_.key(Key::W).released || poll_until([&] { return input_.key(Key::W).released; }));
    EXPECT_FALSE(input_.key(Key::W).down);
    EXPECT_FALSE(input_.key(Key::S).pressed);
}

TEST_F(WindowInput, HeldKeyIsPressedOnceDespiteTheKeyboardsRepeat) {
    act("keydown d");
    ASSERT_TRUE(poll_until([&] { return input_.key(Key::D).pressed; }));
    const auto until = std::chrono::steady_clock::now() + 900ms;  // repeats begin after 660 ms
    while (std::chrono::steady_clock::now() < until) {
        poll();
        ASSERT_FALSE(input_.key(Key::D).pressed);
        ASSERT_TRUE(input_.key(Key::D).down);
    }
    act("keyup d");
    EXPECT_TRUE(poll_until([&] { return input_.key(Key::D).released; }));
}

TEST_F(WindowInput, TypedTextComesAsCharactersOfTheLayout) {
    std::u32string typed;
    act("type 'a1%'");
    EXPECT_TRUE(poll_until([&] { return (typed += input_.typed()).size() >= 3; }));
    EXPECT_EQ(typed, U"a1%");
}

TEST_F(WindowInput, HeldKeyIsReleasedWhenAnotherWindowTakesTheFocus) {
    act("keydown a");
    ASSERT_TRUE(poll_until([&] { return input_.key(Key::A).down; }));
    {
        Window other({.title = "other", .size = {64, 64}});
        EXPECT_TRUE(poll_until([&] { return input_.key(Key::A).released; }));
        EXPECT_FALSE(input_.focused());
    }
    act("keyup a");
}

TEST_F(WindowInput, DragHasTheMovementOfTheMouse) {
    act("mousemove 150 160");
    ASSERT_TRUE(poll_until([&] { return input_.mouse_position() == glm::dvec2(50.0, 60.0); }));
    act("mousedown 1 sleep 0.06 mousemove_relative 30 12 sleep 0.06 mousemove_relative 7 5 sleep 0.06 mouseup 1");
    act("mousemove_relative 40 40");
    ASSERT_TRUE(poll_until([&] { return input_.mouse_position() == glm::dvec2(127.0, 117.0); }));
    EXPECT_EQ(dragged_, glm::dvec2(37.0, 17.0));
    EXPECT_FALSE(input_.mouse_button(MouseButton::Left).down);
}

TEST_F(WindowInput, WheelScrollsANotchAwayAsPlusOne) {
    act("mousemove 150 160 click 4");
    ASSERT_TRUE(poll_until([&] { return input_.scroll().y != 0.0; }));
    EXPECT_EQ(input_.scroll(), glm::dvec2(0.0, 1.0));
}

TEST_F(WindowInput, CaptureMakesNoJumpAndMovementAfterItCounts) {
    act("mousemove 110 110");
    settle();
    act("mousemove 450 360");  // still under way when the cursor is captured and put elsewhere
    window_.set_cursor_captured(true);
    EXPECT_TRUE(window_.cursor_captured());
    moved_ = glm::dvec2(0.0);
    settle();
    EXPECT_EQ(moved_, glm::dvec2(0.0));
    act("mousemove_relative 3 3");  // the first movement may count as none
    settle();
    moved_ = glm::dvec2(0.0);
    // Further than the window is wide: a captured cursor meets no edge.
    for (int i = 0; i < 10; ++i) {
        act("mousemove_relative 80 20");
        settle();
    }
    EXPECT_EQ(moved_, glm::dvec2(800.0, 200.0));
}

TEST_F(WindowInput, LettingTheCursorGoMakesNoJump) {
    act("mousemove 150 160");
    settle();
    window_.set_cursor_captured(true);
    settle();
    act("mousemove_relative 90 70");
    settle();
    moved_ = glm::dvec2(0.0);
    window_.set_cursor_captured(false);
    settle();
    EXPECT_EQ(moved_, glm::dvec2(0.0));
    act("mousemove 170 165");  // from where it was captured
    settle();
    EXPECT_LT(std::abs(moved_.x), 21.0);
    EXPECT_LT(std::abs(moved_.y), 6.0);
}

}  // namespace
}  // namespace rowland::platform
