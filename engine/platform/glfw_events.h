#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "engine/platform/input.h"

struct GLFWwindow;

namespace rowland::platform {

/// GLFW's number for a key or button, as ours; nothing for one that we do not name.
std::optional<Key> key_of_glfw(int key);
std::optional<MouseButton> mouse_button_of_glfw(int button);

/// What happened in a window since someone last looked.
struct WindowEvents {
    std::vector<InputEvent> input;
    std::vector<std::vector<std::filesystem::path>> drops;  ///< the files of each drop
};

/// Appends what happens in `window` to `events`, which becomes the window's user pointer and must outlive it.
void collect_events(GLFWwindow* window, WindowEvents& events);

/// The first game pad that GLFW knows the layout of; not connected if there is none.
GamepadEvent read_gamepad();

}  // namespace rowland::platform
