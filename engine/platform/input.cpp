#include "engine/platform/input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/check.h"

namespace rowland::platform {

namespace {

void set_down(ButtonState& button, bool down) {
    if (down && !button.down) button.pressed = true;
    if (!down && button.down) button.released = true;
    button.down = down;
}

template <typename Buttons>
void begin_frame_of(Buttons& buttons) {
    for (ButtonState& button : buttons) button.pressed = button.released = false;
}

template <typename Buttons>
void release_all(Buttons& buttons) {
    for (ButtonState& button : buttons) set_down(button, false);
}

/// Whether `c` may be in a text: it is neither a control character nor half of a surrogate pair.
bool is_text(char32_t c) {
    const bool control = c < 0x20 || (c >= 0x7F && c < 0xA0);
    const bool surrogate = c >= 0xD800 && c < 0xE000;
    return !control && !surrogate && c <= 0x10FFFF;
}

bool is_finite(glm::dvec2 v) {
    return std::isfinite(v.x) && std::isfinite(v.y);
}

}  // namespace

std::size_t events_of_one_frame(std::span<const InputEvent> events) {
    bool pressed = false;
    for (std::size_t i = 0; i < events.size(); ++i) {
        const KeyEvent* key = std::get_if<KeyEvent>(&events[i]);
        const MouseButtonEvent* button = std::get_if<MouseButtonEvent>(&events[i]);
        const bool modifier = key != nullptr && key->key >= Key::LeftShift;
        if (pressed && (modifier || std::holds_alternative<FocusEvent>(events[i]))) return i;
        pressed = pressed || (key != nullptr && key->down && !modifier) || (button != nullptr && button->down);
    }
    return events.size();
}

glm::vec2 radial_dead_zone(glm::vec2 stick) {
    const float length = glm::length(stick);
    // The negation also catches NaN.
    if (!(length > kStickDeadZone) || !std::isfinite(length)) return glm::vec2(0.0F);
    const float rescaled = std::min((length - kStickDeadZone) / (1.0F - kStickDeadZone), 1.0F);
    return stick * (rescaled / length);
}

void InputState::begin_frame() {
    begin_frame_of(keys_);
    begin_frame_of(buttons_);
    begin_frame_of(pad_);
    mouse_drag_.fill(glm::dvec2(0.0));
    mouse_delta_ = glm::dvec2(0.0);
    scroll_ = glm::dvec2(0.0);
    typed_.clear();
}

void InputState::apply(const InputEvent& event) {
    std::visit([this](const auto& concrete) { on(concrete); }, event);
}

bool InputState::any_down() const {
    return std::ranges::any_of(keys_, &ButtonState::down) || std::ranges::any_of(buttons_, &ButtonState::down);
}

float InputState::key_axis(Key negative, Key positive) const {
    const auto active = [this](Key k) { return key(k).down || key(k).pressed ? 1.0F : 0.0F; };
    return active(positive) - active(negative);
}

glm::vec2 InputState::left_stick() const {
    return radial_dead_zone({raw_axis(GamepadAxis::LeftX), raw_axis(GamepadAxis::LeftY)});
}

glm::vec2 InputState::right_stick() const {
    return radial_dead_zone({raw_axis(GamepadAxis::RightX), raw_axis(GamepadAxis::RightY)});
}

void InputState::on(const KeyEvent& event) {
    set_down(keys_[static_cast<std::size_t>(event.key)], event.down);
}

void InputState::on(const MouseButtonEvent& event) {
    if (event.down) press_position_[static_cast<std::size_t>(event.button)] = mouse_position_;
    set_down(buttons_[static_cast<std::size_t>(event.button)], event.down);
}

void InputState::on(const MouseMoveEvent& event) {
    if (!is_finite(event.position)) return;
    if (position_known_) {
        const glm::dvec2 delta = event.position - mouse_position_;
        mouse_delta_ += delta;
        for (std::size_t i = 0; i < buttons_.size(); ++i)
            if (buttons_[i].down) mouse_drag_[i] += delta;
    }
    mouse_position_ = event.position;
    position_known_ = true;
}

void InputState::on(const ScrollEvent& event) {
    if (is_finite(event.offset)) scroll_ += event.offset;
}

void InputState::on(const FocusEvent& event) {
    focused_ = event.focused;
    position_known_ = false;
    if (focused_) return;
    release_all(keys_);
    release_all(buttons_);
    release_all(pad_);
    gamepad_.axes.fill(0.0F);
}

void InputState::on(const CursorCaptureEvent&) {
    position_known_ = false;
}

void InputState::on(const GamepadEvent& event) {
    gamepad_.connected = event.connected;
    // The pad is read even while another program has the focus, which the player may be using.
    const GamepadEvent reading = event.connected && focused_ ? event : GamepadEvent{};
    gamepad_.axes = reading.axes;
    for (std::size_t i = 0; i < pad_.size(); ++i) set_down(pad_[i], reading.buttons[i]);
}

void InputState::on(const CharEvent& event) {
    if (is_text(event.codepoint)) typed_.push_back(event.codepoint);
}

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

std::optional<MouseButton> mouse_button_of_glfw(int glfw) {
    static_assert(static_cast<int>(MouseButton::Left) == GLFW_MOUSE_BUTTON_LEFT);
    static_assert(static_cast<int>(MouseButton::Right) == GLFW_MOUSE_BUTTON_RIGHT);
    static_assert(static_cast<int>(MouseButton::Middle) == GLFW_MOUSE_BUTTON_MIDDLE);
    if (glfw < GLFW_MOUSE_BUTTON_LEFT || glfw > GLFW_MOUSE_BUTTON_MIDDLE) return std::nullopt;
    return static_cast<MouseButton>(glfw);
}

}  // namespace rowland::platform
