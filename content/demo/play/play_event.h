#pragma once

#include <glm/vec2.hpp>
#include <variant>

#include "content/demo/play/action.h"
#include "content/demo/play/setting.h"
#include "engine/platform/input.h"

namespace rowland::demo {

/// The window's new size, in the mouse's units; each >= 1.
struct ResizeEvent {
    glm::ivec2 size{1};
};
/// An action that was chosen in a panel, not by its key.
struct ActionEvent {
    Action action;
};

/// All input of a play besides the scene: the same events at the same steps make the same play.
using PlayEvent = std::variant<platform::InputEvent, ResizeEvent, ActionEvent, SettingEvent>;

}  // namespace rowland::demo
