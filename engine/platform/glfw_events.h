#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "engine/platform/input.h"

struct GLFWwindow;

namespace rowland::platform {

/// The button of a GLFW number; nullopt for one that MouseButton does not have.
std::optional<MouseButton> mouse_button_of_glfw(int button);

/// What happened in a window since the last poll.
struct WindowEvents {
    std::vector<InputEvent> input;
    std::vector<std::vector<std::filesystem::path>> drops;  ///< the files of each drop
    bool exposed = false;                                   ///< the window's content is lost
};

/// Appends what happens in `window` to `events`, which becomes the window's user pointer and must outlive the window.
void collect_events(GLFWwindow* window, WindowEvents& events);

/// The first game pad whose layout GLFW knows; not connected if there is none.
GamepadEvent read_gamepad();

}  // namespace rowland::platform
