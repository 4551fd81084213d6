#include "engine/platform/key.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <array>

#include "engine/core/check.h"

namespace rowland::platform {

namespace {

struct KeyRow {
    int glfw;
    const char* name;
};

// From Key::Left on, in the order of the enumeration. The keys before it are the runs A to Z, 0 to 9 and F1 to F12,
// which GLFW numbers in the same order.
constexpr std::array kRows{
    KeyRow{GLFW_KEY_LEFT, "Left"},
    KeyRow{GLFW_KEY_RIGHT, "Right"},
    KeyRow{GLFW_KEY_UP, "Up"},
    KeyRow{GLFW_KEY_DOWN, "Down"},
    KeyRow{GLFW_KEY_HOME, "Home"},
    KeyRow{GLFW_KEY_END, "End"},
    KeyRow{GLFW_KEY_PAGE_UP, "Page Up"},
    KeyRow{GLFW_KEY_PAGE_DOWN, "Page Down"},
    KeyRow{GLFW_KEY_INSERT, "Insert"},
    KeyRow{GLFW_KEY_DELETE, "Delete"},
    KeyRow{GLFW_KEY_SPACE, "Space"},
    KeyRow{GLFW_KEY_ENTER, "Enter"},
    KeyRow{GLFW_KEY_ESCAPE, "Esc"},
    KeyRow{GLFW_KEY_TAB, "Tab"},
    KeyRow{GLFW_KEY_BACKSPACE, "Backspace"},
    KeyRow{GLFW_KEY_MINUS, "-"},
    KeyRow{GLFW_KEY_EQUAL, "="},
    KeyRow{GLFW_KEY_COMMA, ","},
    KeyRow{GLFW_KEY_PERIOD, "."},
    KeyRow{GLFW_KEY_SLASH, "/"},
    KeyRow{GLFW_KEY_GRAVE_ACCENT, "`"},
    KeyRow{GLFW_KEY_LEFT_BRACKET, "["},
    KeyRow{GLFW_KEY_RIGHT_BRACKET, "]"},
    KeyRow{GLFW_KEY_LEFT_SHIFT, "Left Shift"},
    KeyRow{GLFW_KEY_RIGHT_SHIFT, "Right Shift"},
    KeyRow{GLFW_KEY_LEFT_CONTROL, "Left Ctrl"},
    KeyRow{GLFW_KEY_RIGHT_CONTROL, "Right Ctrl"},
    KeyRow{GLFW_KEY_LEFT_ALT, "Left Alt"},
    KeyRow{GLFW_KEY_RIGHT_ALT, "Right Alt"},
};

constexpr int index(Key key) {
    return static_cast<int>(key);
}
static_assert(index(Key::Left) + static_cast<int>(kRows.size()) == index(Key::Count));
static_assert(index(Key::Digit0) == 26 && index(Key::F1) == 36 && index(Key::Left) == 48);

int glfw_of(Key key) {
    if (key < Key::Digit0) return GLFW_KEY_A + index(key);
    if (key < Key::F1) return GLFW_KEY_0 + index(key) - index(Key::Digit0);
    if (key < Key::Left) return GLFW_KEY_F1 + index(key) - index(Key::F1);
    return kRows[static_cast<std::size_t>(index(key) - index(Key::Left))].glfw;
}

}  // namespace

std::string name_of(Key key) {
    ROWLAND_CHECK_OP(index(key), <, index(Key::Count));
    if (key < Key::Digit0) return {static_cast<char>('A' + index(key))};
    if (key < Key::F1) return std::to_string(index(key) - index(Key::Digit0));
    if (key < Key::Left) return fmt::format("F{}", index(key) - index(Key::F1) + 1);
    return kRows[static_cast<std::size_t>(index(key) - index(Key::Left))].name;
}

std::optional<Key> key_named(std::string_view name) {
    for (int i = 0; i < index(Key::Count); ++i)
        if (name_of(static_cast<Key>(i)) == name) return static_cast<Key>(i);
    return std::nullopt;
}

std::optional<Key> key_of_glfw(int glfw) {
    if (glfw == GLFW_KEY_KP_ENTER) return Key::Enter;
    for (int i = 0; i < index(Key::Count); ++i)
        if (glfw_of(static_cast<Key>(i)) == glfw) return static_cast<Key>(i);
    return std::nullopt;
}

}  // namespace rowland::platform
