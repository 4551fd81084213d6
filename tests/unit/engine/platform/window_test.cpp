#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <thread>

#include "engine/gpu/framebuffer.h"
#include "engine/platform/gl_context.h"
#include "engine/platform/window.h"
#include "tests/support/expect.h"
#include "tests/support/program.h"

// Needs a display (on_virtual_display.cpp) and xdotool, which moves the pointer and the keys as the server's own
// devices do.

namespace rowland::platform {

namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;

using Pixel = std::array<std::uint8_t, 4>;

/// Polls until `done`; false if that takes longer than a display server ever needs.
bool poll_until(Window& window, const std::function<bool()>& done) {
    InputState input;
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    while (!done()) {
        if (std::chrono::steady_clock::now() > deadline) return false;
        window.poll(input);
        std::this_thread::sleep_for(2ms);
    }
    return true;
}

Pixel cleared_corner(Window& window, float red, float green, float blue) {
    const glm::ivec2 size = window.framebuffer_size();
    glViewport(0, 0, size.x, size.y);
    glClearColor(red, green, blue, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    Pixel pixel{};
    glReadPixels(size.x - 1, size.y - 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    return pixel;
}

/// The X server's number of a window.
std::string number_of(const std::string& title) {
    const std::string found =
        test::run({"/usr/bin/env", "xdotool", "search", "--sync", "--name", "^" + title + "$"}).out;
    return found.substr(0, found.find('\n'));
}

TEST(Window, DisplayIsAvailable) {
    EXPECT_TRUE(display_available());
}

TEST(Window, OutlivesASourceOfADragThatExitsBeforeItIsAnswered) {
    Window window({.title = "outlives", .size = {64, 64}});
    InputState input;
    window.poll(input);
    ASSERT_EQ(test::run({ROWLAND_DROP_FILES, "--die", number_of("outlives")}).code, 0);
    testing::internal::CaptureStderr();
    window.poll(input);  // answers a window that no longer exists
    window.position();   // waits for the server
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("the X server refused request"));
}

TEST(Window, HasADebugContextOfOpenGl45Core) {
    Window window({.title = "test", .size = {64, 64}, .debug = true});
    EXPECT_GE(epoxy_gl_version(), 45);
    GLint profile = 0;
    GLint flags = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
    EXPECT_NE(profile & GL_CONTEXT_CORE_PROFILE_BIT, 0);
    EXPECT_NE(flags & GL_CONTEXT_FLAG_DEBUG_BIT, 0);
}

TEST(Window, DrawsOnTheGpuThatIsChosenOrRefuses) {
    const std::string renderer = HeadlessContext().renderer();
    EXPECT_THAT(test::message_of([] {
                    const Window window({.title = "test", .size = {64, 64}, .gpu = "no such"});
                }),
                AllOf(HasSubstr("no GPU \"no such\""), HasSubstr("0 = " + renderer)));
    const Window window({.title = "test", .size = {64, 64}, .gpu = renderer});
    EXPECT_EQ(reinterpret_cast<const char*>(glGetString(GL_RENDERER)), renderer);
    EXPECT_THAT(test::message_of([] { require_gpu_of_window("another GPU"); }, Fault::System),
                AllOf(HasSubstr(renderer), HasSubstr("another GPU"), HasSubstr("set DRI_PRIME=1")));
}

TEST(Window, ShowsTheClearColourToItsLastCornerBeforeAndAfterResize) {
    Window window({.title = "test", .size = {200, 120}});
    EXPECT_EQ(window.size(), glm::ivec2(200, 120));
    EXPECT_EQ(cleared_corner(window, 1.0F, 0.0F, 0.4F), (Pixel{255, 0, 102, 255}));
    window.swap();
    window.resize({320, 240});
    ASSERT_TRUE(poll_until(window, [&] { return window.framebuffer_size() == glm::ivec2(320, 240); }));
    window.swap();  // the driver takes over the new size with the next frame
    EXPECT_EQ(cleared_corner(window, 0.0F, 1.0F, 0.4F), (Pixel{0, 255, 102, 255}));
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(Window, APictureFillsItsWindowOnTheScreenAfterEachResize) {
    Window window({.title = "resized", .size = {200, 120}});
    window.swap();
    const std::string number = number_of("resized");
    const auto pixel = [&](int x, int y) {
        return test::run({ROWLAND_DROP_FILES, "--pixel", number, std::to_string(x), std::to_string(y)}).out;
    };
    for (const glm::ivec2 size : {glm::ivec2(320, 240), {160, 100}}) {
        window.resize(size);
        ASSERT_TRUE(poll_until(window, [&] { return window.framebuffer_size() == size; }));
        const gpu::Framebuffer picture({.width = size.x, .height = size.y, .colours = {gpu::Format::RGBA8}});
        picture.bind();
        picture.clear({0.0F, 1.0F, 0.0F, 1.0F});
        const std::array<std::uint8_t, 4> red{255, 0, 0, 255};
        glClearTexSubImage(picture.colour().id(), 0, 0, size.y - 1, 0, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, red.data());
        // The software renderer takes over the new size with a frame.
        for (int frame = 0; frame < 2; ++frame) {
            picture.show_in_window();
            window.swap();
        }
        window.position();  // waits for the server
        EXPECT_EQ(pixel(0, 0), "ff0000") << size.x;
        EXPECT_EQ(pixel(size.x - 1, size.y - 1), "00ff00") << size.x;
    }
}

TEST(Window, FullScreenFillsTheMonitorAndComesBackToItsPlace) {
    Window window({.title = "test", .size = {200, 120}});
    window.set_position({70, 40});
    ASSERT_TRUE(poll_until(window, [&] { return window.position() == glm::ivec2(70, 40); }));
    const glm::ivec2 screen{ROWLAND_TEST_SCREEN_WIDTH, ROWLAND_TEST_SCREEN_HEIGHT};
    for (int i = 0; i < 2; ++i) {
        window.set_fullscreen(true);
        window.set_fullscreen(true);  // a second time changes nothing, not even what is remembered
        EXPECT_TRUE(window.fullscreen());
        EXPECT_TRUE(poll_until(window, [&] { return window.framebuffer_size() == screen; }));
        window.set_fullscreen(false);
        EXPECT_FALSE(window.fullscreen());
        EXPECT_TRUE(poll_until(window, [&] { return window.size() == glm::ivec2(200, 120); }));
        EXPECT_TRUE(poll_until(window, [&] { return window.position() == glm::ivec2(70, 40); }));
    }
}

TEST(Window, ClosesOnlyWhenAsked) {
    Window window({.title = "test", .size = {64, 64}});
    EXPECT_FALSE(window.should_close());
    window.request_close();
    EXPECT_TRUE(window.should_close());
    window.request_close(false);
    EXPECT_FALSE(window.should_close());
}

/// Drops files as GLFW reports them: all of its own part, from the display's protocol to the paths, is left out.
void drop(Window& window, std::vector<const char*> paths) {
    const GLFWdropfun on_drop = glfwSetDropCallback(window.native(), nullptr);
    ASSERT_NE(on_drop, nullptr);
    glfwSetDropCallback(window.native(), on_drop);
    on_drop(window.native(), static_cast<int>(paths.size()), paths.data());
}

TEST(Window, DroppedFilesReachTheHandlerOnceFromPoll) {
    Window window({.title = "test", .size = {64, 64}});
    std::vector<std::vector<std::filesystem::path>> drops;
    InputState input;
    drop(window, {"/ignored.hdr"});  // nobody listens yet
    window.poll(input);
    window.set_drop_handler([&](const auto& files) { drops.push_back(files); });
    drop(window, {"/a/sky.hdr", "/a/caf\u00e9.exr"});
    EXPECT_TRUE(drops.empty());
    window.poll(input);
    window.poll(input);
    ASSERT_EQ(drops.size(), 1U);
    EXPECT_EQ(drops[0], (std::vector<std::filesystem::path>{"/a/sky.hdr", u8"/a/caf\u00e9.exr"}));
}

TEST(Window, WhatTheDropHandlerThrowsIsPassedOn) {
    Window window({.title = "test", .size = {64, 64}});
    InputState input;
    window.set_drop_handler([](const auto&) { throw std::runtime_error("refused"); });
    drop(window, {"/a/sky.hdr"});
    EXPECT_THROW(window.poll(input), std::runtime_error);
    EXPECT_NO_THROW(window.poll(input));
}

TEST(Window, SeveralKeepTheirOwnPictures) {
    Window first({.title = "first", .size = {64, 64}});
    Window second({.title = "second", .size = {64, 64}});
    first.make_current();
    EXPECT_EQ(cleared_corner(first, 1.0F, 0.0F, 0.0F), (Pixel{255, 0, 0, 255}));
    second.make_current();
    EXPECT_EQ(cleared_corner(second, 0.0F, 0.0F, 1.0F), (Pixel{0, 0, 255, 255}));
}

TEST(Window, OpensAgainAfterAllWereClosed) {
    { Window window({.title = "test", .size = {64, 64}}); }
    Window window({.title = "test", .size = {64, 64}});
    EXPECT_EQ(cleared_corner(window, 0.0F, 1.0F, 0.0F), (Pixel{0, 255, 0, 255}));
}

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

TEST_F(WindowInput, AModifierReleasedBetweenTwoPollsIsStillDownForTheKeyBeforeIt) {
    act("keydown ctrl");
    ASSERT_TRUE(poll_until([&] { return input_.key(Key::LeftControl).down; }));
    act("key a keyup ctrl");
    ASSERT_TRUE(poll_until([&] { return input_.key(Key::A).pressed; }));
    EXPECT_TRUE(input_.key(Key::LeftControl).down);
    EXPECT_TRUE(poll_until([&] { return input_.key(Key::LeftControl).released; }));
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
