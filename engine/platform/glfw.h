#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/platform/input.h"

struct GLFWwindow;

namespace rowland::platform {

/// GLFW is initialised while someone holds this. Main thread only.
class GlfwLibrary {
 public:
    /// Initialises GLFW if nobody holds it; null if that fails, with GLFW's reason in `reason`.
    static std::shared_ptr<GlfwLibrary> acquire(std::string& reason);
    ~GlfwLibrary();
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;

 private:
    GlfwLibrary() = default;
};

/// Returns and clears GLFW's last error; empty if there was none.
std::string take_glfw_error();

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
