// Needs a display (on_virtual_display.cpp).
#include "engine/platform/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "engine/platform/gpu_choice.h"
#include "engine/platform/headless_context.h"
#include "tests/support/message_of.h"

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

TEST(Window, DisplayIsAvailable) {
    EXPECT_TRUE(display_available());
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

}  // namespace
}  // namespace rowland::platform
