#include "content/demo/play/key_name.h"

#include <fmt/format.h>

#include <array>

#include "engine/core/check.h"

namespace rowland::demo {

namespace {

using platform::Key;

constexpr int index(Key key) {
    return static_cast<int>(key);
}

// From Left on, in the order of the enumeration; the keys before it are runs.
constexpr std::array kNames{
    "Left",  "Right", "Up",  "Down",       "Home",        "End",       "Page Up",    "Page Down", "Insert",   "Delete",
    "Space", "Enter", "Esc", "Tab",        "Backspace",   "-",         "=",          ",",         ".",        "/",
    "`",     "[",     "]",   "Left Shift", "Right Shift", "Left Ctrl", "Right Ctrl", "Left Alt",  "Right Alt"};
static_assert(index(Key::Left) + static_cast<int>(kNames.size()) == index(Key::Count));
static_assert(index(Key::Digit0) == 26 && index(Key::F1) == 36 && index(Key::Left) == 48);

}  // namespace

std::string name_of(Key key) {
    ROWLAND_CHECK_OP(index(key), <, index(Key::Count));
    if (key < Key::Digit0) return {static_cast<char>('A' + index(key))};
    if (key < Key::F1) return std::to_string(index(key) - index(Key::Digit0));
    if (key < Key::Left) return fmt::format("F{}", index(key) - index(Key::F1) + 1);
    return kNames[static_cast<std::size_t>(index(key) - index(Key::Left))];
}

std::optional<Key> key_named(std::string_view name) {
    for (int i = 0; i < index(Key::Count); ++i)
        if (name_of(static_cast<Key>(i)) == name) return static_cast<Key>(i);
    return std::nullopt;
}

}  // namespace rowland::demo
