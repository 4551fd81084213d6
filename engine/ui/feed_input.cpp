#include "engine/ui/feed_input.h"

#include <imgui.h>

#include <array>
#include <limits>

namespace rowland::ui {

namespace {

using platform::Key;
using platform::MouseButton;

struct EditingKey {
    int imgui;
    Key key;
};

constexpr std::array kEditingKeys{
    EditingKey{ImGuiKey_Tab, Key::Tab},
    EditingKey{ImGuiKey_LeftArrow, Key::Left},
    EditingKey{ImGuiKey_RightArrow, Key::Right},
    EditingKey{ImGuiKey_UpArrow, Key::Up},
    EditingKey{ImGuiKey_DownArrow, Key::Down},
    EditingKey{ImGuiKey_PageUp, Key::PageUp},
    EditingKey{ImGuiKey_PageDown, Key::PageDown},
    EditingKey{ImGuiKey_Home, Key::Home},
    EditingKey{ImGuiKey_End, Key::End},
    EditingKey{ImGuiKey_Insert, Key::Insert},
    EditingKey{ImGuiKey_Delete, Key::Delete},
    EditingKey{ImGuiKey_Backspace, Key::Backspace},
    EditingKey{ImGuiKey_Space, Key::Space},
    EditingKey{ImGuiKey_Enter, Key::Enter},
    EditingKey{ImGuiKey_Escape, Key::Escape},
    EditingKey{ImGuiKey_A, Key::A},
    EditingKey{ImGuiKey_C, Key::C},
    EditingKey{ImGuiKey_V, Key::V},
    EditingKey{ImGuiKey_X, Key::X},
    EditingKey{ImGuiKey_Y, Key::Y},
    EditingKey{ImGuiKey_Z, Key::Z},
};

/// In the order of ImGui's mouse buttons.
constexpr std::array kMouseButtons{MouseButton::Left, MouseButton::Right, MouseButton::Middle};

bool was_down(const platform::ButtonState& button) {
    return button.down || button.pressed;
}

bool either_down(const platform::InputState& input, Key left, Key right) {
    return was_down(input.key(left)) || was_down(input.key(right));
}

}  // namespace

void map_keys(ImGuiIO& io) {
    for (const EditingKey& editing : kEditingKeys) io.KeyMap[editing.imgui] = static_cast<int>(editing.key);
}

void InputFeed::feed(const platform::InputState& input, ImGuiIO& io) {
    for (int key = 0; key < static_cast<int>(Key::Count); ++key)
        io.KeysDown[key] = was_down(input.key(static_cast<Key>(key)));
    io.KeyCtrl = either_down(input, Key::LeftControl, Key::RightControl);
    io.KeyShift = either_down(input, Key::LeftShift, Key::RightShift);
    io.KeyAlt = either_down(input, Key::LeftAlt, Key::RightAlt);
    for (const char32_t c : input.typed()) io.AddInputCharacter(static_cast<unsigned>(c));
    feed_mouse(input, io);
    io.MouseWheelH += static_cast<float>(input.scroll().x);
    io.MouseWheel += static_cast<float>(input.scroll().y);
}

void InputFeed::feed_mouse(const platform::InputState& input, ImGuiIO& io) {
    glm::dvec2 position = input.mouse_position();
    for (const MouseButton button : kMouseButtons)
        if (input.mouse_button(button).pressed) position = input.press_position(button);
    for (std::size_t i = 0; i < kMouseButtons.size(); ++i) {
        const bool moves_first = down_[i] && position != seen_;
        down_[i] = was_down(input.mouse_button(kMouseButtons[i])) || moves_first;
        io.MouseDown[i] = down_[i];
    }
    seen_ = position;
    // ImGui's word for "no mouse".
    constexpr float kNowhere = -std::numeric_limits<float>::max();
    const glm::vec2 shown(position);
    io.MousePos = input.focused() ? ImVec2(shown.x, shown.y) : ImVec2(kNowhere, kNowhere);
}

}  // namespace rowland::ui
