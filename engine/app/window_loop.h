#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/platform/frame_pacing.h"
#include "engine/platform/window.h"

namespace rowland::app {

/// What has happened in the window since the last frame.
struct Frame {
    std::vector<platform::InputEvent> events;
    std::vector<std::filesystem::path> dropped;  ///< files
    std::chrono::nanoseconds elapsed{0};         ///< since the last frame that was drawn; 0 in the first
    bool woken = false;                          ///< the loop waited, and something happened to the window
    glm::ivec2 size{0};                          ///< of the window, in the mouse's units
    glm::ivec2 pixels{0};                        ///< of its framebuffer; 0 while it is minimised

    double seconds() const { return std::chrono::duration<double>(elapsed).count(); }
};

enum class Next {
    Frame,  ///< draw, then update as soon as the display takes it
    Watch,  ///< draw nothing; update when something happens to the window, or soon, for the results of background work
    Wait,   ///< draw nothing; update when something happens to the window, or after a second
    End,
};

/// A window with a current OpenGL context, and the loop that draws in it.
class WindowLoop {
 public:
    /// `debug`: the driver's messages are logged. Throws Error (system) without a display or OpenGL 4.5 core.
    WindowLoop(const std::string& title, glm::ivec2 size, bool debug);

    platform::Window& window() { return window_; }
    const platform::Window& window() const { return window_; }
    /// The times of the last frames, without those that followed a wait.
    const platform::FrameTimes& times() const { return times_; }

    /// Until `update` returns End: polls the window and calls `update`; if that returns Frame and the window is not
    /// minimised, also calls `draw` and shows what it drew.
    void run(const std::function<Next(const Frame&)>& update, const std::function<void(const Frame&)>& draw);

 private:
    Frame next_frame();

    platform::Window window_;
    std::vector<std::filesystem::path> dropped_;
    platform::FrameClock clock_;
    platform::FrameTimes times_;
    std::chrono::nanoseconds since_drawn_{0};
    bool waited_ = false;  ///< since the last frame
    bool woken_ = false;
};

}  // namespace rowland::app
