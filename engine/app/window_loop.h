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
    std::chrono::nanoseconds elapsed{0};         ///< since the last frame; 0 in the first
    glm::ivec2 size{0};                          ///< of the window, in the mouse's units
    glm::ivec2 pixels{0};                        ///< of its framebuffer; 0 while it is minimised

    double seconds() const { return std::chrono::duration<double>(elapsed).count(); }
};

enum class Next {
    Frame,  ///< the next one, as soon as the display takes it
    Rest,   ///< the next one, after a short sleep that leaves the processor to background work
    End,
};

/// A window with a current OpenGL context, and the loop that draws in it.
class WindowLoop {
 public:
    /// `debug`: the driver's messages are logged. Throws Error (system) without a display or OpenGL 4.5 core.
    WindowLoop(const std::string& title, glm::ivec2 size, bool debug);

    platform::Window& window() { return window_; }
    const platform::Window& window() const { return window_; }
    /// Of the last frames.
    const platform::FrameTimes& times() const { return times_; }

    /// Until `update` returns End: polls the window, calls `update`, then `draw` and shows what it drew. A minimised
    /// window draws nothing.
    void run(const std::function<Next(const Frame&)>& update, const std::function<void(const Frame&)>& draw);

 private:
    Frame next_frame();

    platform::Window window_;
    std::vector<std::filesystem::path> dropped_;
    platform::FrameClock clock_;
    platform::FrameTimes times_;
};

}  // namespace rowland::app
