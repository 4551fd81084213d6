#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace rowland::platform {

/// Keys by their position on a US keyboard, so that WASD is the same cluster on every layout.
enum class Key {
    // clang-format off
    A, B, C, D, E, F, G, H, I, J, K, L, M, N, O, P, Q, R, S, T, U, V, W, X, Y, Z,
    Digit0, Digit1, Digit2, Digit3, Digit4, Digit5, Digit6, Digit7, Digit8, Digit9,
    F1, F2, F3, F4, F5, F6, F7, F8, F9, F10, F11, F12,
    Left, Right, Up, Down, Home, End, PageUp, PageDown, Insert, Delete,
    Space, Enter, Escape, Tab, Backspace, Minus, Equal, Comma, Period, Slash, GraveAccent, LeftBracket, RightBracket,
    LeftShift, RightShift, LeftControl, RightControl, LeftAlt, RightAlt,  // the modifiers, last
    Count  // not a key
    // clang-format on
};

enum class MouseButton { Left, Right, Middle, Count };

/// Sticks: x to the right and y *up* (away from the player), -1 to 1. Triggers: 0 (released) to 1.
enum class GamepadAxis { LeftX, LeftY, RightX, RightY, LeftTrigger, RightTrigger, Count };

/// South, East, West and North are the four face buttons (A, B, X and Y on an Xbox pad).
enum class GamepadButton {
    // clang-format off
    South, East, West, North, LeftBumper, RightBumper, Back, Start, Guide, LeftThumb, RightThumb, Up, Right, Down, Left,
    Count  // not a button
    // clang-format on
};

/// One value for each enumerator of E except Count.
template <typename E, typename T>
using PerEnum = std::array<T, static_cast<std::size_t>(E::Count)>;

struct KeyEvent {
    Key key;
    bool down;
};
struct MouseButtonEvent {
    MouseButton button;
    bool down;
};
struct MouseMoveEvent {
    glm::dvec2 position;  ///< screen coordinates from the window's upper left corner, y down
};
struct ScrollEvent {
    glm::dvec2 offset;  ///< notches; y grows away from the user
};
/// The window gained or lost the keyboard focus.
struct FocusEvent {
    bool focused;
};
/// The cursor was captured or released; positions before and after are not comparable.
struct CursorCaptureEvent {
    bool captured;
};
/// The whole state of the game pad, before any dead zone.
struct GamepadEvent {
    bool connected = false;
    PerEnum<GamepadAxis, float> axes{};
    PerEnum<GamepadButton, bool> buttons{};
};

/// A typed character, by the user's layout. A held key repeats.
struct CharEvent {
    char32_t codepoint = 0;
};

using InputEvent = std::variant<KeyEvent, MouseButtonEvent, MouseMoveEvent, ScrollEvent, FocusEvent, CursorCaptureEvent,
                                GamepadEvent, CharEvent>;

/// The number of `events` that one frame takes: all, or those before a modifier (Shift, Control, Alt) or the focus
/// changes after another key or a mouse button went down. At the end of the frame, the modifiers are those that each of
/// its presses was made with, however long the frame took.
std::size_t events_of_one_frame(std::span<const InputEvent> events);

/// Fraction of a stick's travel that reads as centred; released worn sticks may stop anywhere inside it.
constexpr float kStickDeadZone = 0.15F;

/// Removes the dead zone of `stick` (each axis -1 to 1): 0 up to length kStickDeadZone, then growing to length 1 at
/// full travel, in the same direction. Radial, so that a stick does not snap to the axes. A stick that is not finite
/// gives 0.
glm::vec2 radial_dead_zone(glm::vec2 stick);

/// A button of any device during one frame. A press and release within one frame set both flags, with `down` false.
struct ButtonState {
    bool down = false;      ///< at the end of the frame
    bool pressed = false;   ///< went down during the frame
    bool released = false;  ///< went up during the frame

    friend bool operator==(const ButtonState&, const ButtonState&) = default;
};

/// The user's input during one frame. It is fed by events and needs no window: `begin_frame`, then `apply` each event
/// of the frame in order, then query. Losing the focus releases every key and button and centres the game pad until the
/// focus is back.
class InputState {
 public:
    /// Clears movement, text and the flags `pressed` and `released`, not `down`.
    void begin_frame();
    void apply(const InputEvent& event);

    const ButtonState& key(Key key) const { return keys_[static_cast<std::size_t>(key)]; }
    const ButtonState& mouse_button(MouseButton button) const { return buttons_[static_cast<std::size_t>(button)]; }
    /// Whether a key or a mouse button is down at the end of the frame.
    bool any_down() const;
    const ButtonState& gamepad_button(GamepadButton button) const { return pad_[static_cast<std::size_t>(button)]; }

    /// A key counts if it is down at the end of the frame or was pressed in it: -1 for `negative`, 1 for `positive`, 0
    /// for neither or both.
    float key_axis(Key negative, Key positive) const;

    /// Screen coordinates, y down; unbounded while the cursor is captured, when only differences have a meaning.
    glm::dvec2 mouse_position() const { return mouse_position_; }
    /// Movement during the frame. The first movement after a start, a change of focus or a capture counts as none.
    glm::dvec2 mouse_delta() const { return mouse_delta_; }
    /// The part of `mouse_delta` made while `button` was down, even if it went down or up within the frame.
    glm::dvec2 mouse_drag(MouseButton button) const { return mouse_drag_[static_cast<std::size_t>(button)]; }
    /// Where the mouse was when `button` last went down.
    glm::dvec2 press_position(MouseButton button) const { return press_position_[static_cast<std::size_t>(button)]; }
    glm::dvec2 scroll() const { return scroll_; }  ///< notches during the frame

    /// Text typed during the frame: Unicode scalar values without control characters (those are keys).
    const std::u32string& typed() const { return typed_; }

    bool focused() const { return focused_; }
    /// After radial_dead_zone().
    glm::vec2 left_stick() const;
    glm::vec2 right_stick() const;

 private:
    void on(const KeyEvent& event);
    void on(const MouseButtonEvent& event);
    void on(const MouseMoveEvent& event);
    void on(const ScrollEvent& event);
    void on(const FocusEvent& event);
    void on(const CursorCaptureEvent& event);
    void on(const GamepadEvent& event);
    void on(const CharEvent& event);
    float raw_axis(GamepadAxis axis) const { return gamepad_.axes[static_cast<std::size_t>(axis)]; }

    PerEnum<Key, ButtonState> keys_{};
    PerEnum<MouseButton, ButtonState> buttons_{};
    PerEnum<GamepadButton, ButtonState> pad_{};
    PerEnum<MouseButton, glm::dvec2> mouse_drag_{};
    PerEnum<MouseButton, glm::dvec2> press_position_{};
    glm::dvec2 mouse_position_{0.0};
    glm::dvec2 mouse_delta_{0.0};
    glm::dvec2 scroll_{0.0};
    std::u32string typed_;
    GamepadEvent gamepad_;
    bool position_known_ = false;
    bool focused_ = true;
};

/// The label of a key, as "W", "F5" or "Left Shift". Unique.
std::string name_of(Key key);
/// The key with that label; nullopt if there is none.
std::optional<Key> key_named(std::string_view name);

/// The key or button of a GLFW code; nullopt if the enumeration lacks it.
std::optional<Key> key_of_glfw(int glfw);
std::optional<MouseButton> mouse_button_of_glfw(int glfw);

}  // namespace rowland::platform
