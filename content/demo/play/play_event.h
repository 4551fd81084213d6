#pragma once

#include <glm/vec2.hpp>
#include <variant>

#include "content/demo/play/action.h"
#include "content/demo/play/setting.h"
#include "engine/platform/input.h"

namespace rowland::demo {

/// The window has this size now, in the mouse's units; each >= 1.
struct ResizeEvent {
    glm::ivec2 size{1};
};
/// An action was called for otherwise than by its key, say in a menu.
struct ActionEvent {
    Action action;
};

/// All that a play depends on besides the scene: the same events at the same steps make the same play.
using PlayEvent = std::variant<platform::InputEvent, ResizeEvent, ActionEvent, SettingEvent>;

}  // namespace rowland::demo
