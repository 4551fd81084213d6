#include "engine/platform/glfw_events.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <set>

#include "engine/platform/key.h"

namespace rowland::platform {
namespace {

TEST(GlfwEvents, EveryNamedKeyHasAKeyOfTheKeyboard) {
    std::set<Key> reached;
    for (int key = -1; key <= GLFW_KEY_LAST; ++key)
        if (const auto known = key_of_glfw(key)) reached.insert(*known);
    EXPECT_EQ(reached.size(), static_cast<std::size_t>(Key::Count));
    EXPECT_FALSE(reached.contains(Key::Count));
}

TEST(GlfwEvents, KeysAtTheEndsOfRunsAreThemselves) {
    EXPECT_EQ(key_of_glfw(GLFW_KEY_A), Key::A);
    EXPECT_EQ(key_of_glfw(GLFW_KEY_W), Key::W);
    EXPECT_EQ(key_of_glfw(GLFW_KEY_Z), Key::Z);
    EXPECT_EQ(key_of_glfw(GLFW_KEY_0), Key::Digit0);
    EXPECT_EQ(key_of_glfw(GLFW_KEY_9), Key::Digit9);
    EXPECT_EQ(key_of_glfw(GLFW_KEY_F1), Key::F1);
    EXPECT_EQ(key_of_glfw(GLFW_KEY_F12), Key::F12);
    EXPECT_EQ(key_of_glfw(GLFW_KEY_LEFT_SHIFT), Key::LeftShift);
}

TEST(GlfwEvents, UnnamedKeysAndButtonsAreNothing) {
    EXPECT_EQ(key_of_glfw(GLFW_KEY_UNKNOWN), std::nullopt);
    EXPECT_EQ(key_of_glfw(GLFW_KEY_F25), std::nullopt);
    EXPECT_EQ(key_of_glfw(GLFW_KEY_LAST + 1), std::nullopt);
    EXPECT_EQ(mouse_button_of_glfw(GLFW_MOUSE_BUTTON_8), std::nullopt);
}

TEST(GlfwEvents, MouseButtonsAreThemselves) {
    EXPECT_EQ(mouse_button_of_glfw(GLFW_MOUSE_BUTTON_LEFT), MouseButton::Left);
    EXPECT_EQ(mouse_button_of_glfw(GLFW_MOUSE_BUTTON_RIGHT), MouseButton::Right);
    EXPECT_EQ(mouse_button_of_glfw(GLFW_MOUSE_BUTTON_MIDDLE), MouseButton::Middle);
}

}  // namespace
}  // namespace rowland::platform
