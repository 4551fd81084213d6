#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/platform/gl_context.h"
#include "engine/platform/input.h"

struct GLFWwindow;

namespace rowland::platform {

/// A window or a monitor on the desktop, screen coordinates.
struct ScreenArea {
    glm::ivec2 position{0};
    glm::ivec2 size{0};

    friend bool operator==(const ScreenArea&, const ScreenArea&) = default;
};

/// Index of the monitor that shows the largest part of `window`: of equals the first, and 0 (the primary one) if none
/// shows any of it.
std::size_t monitor_showing(const ScreenArea& window, std::span<const ScreenArea> monitors);

/// Whether a Window can open: X11 or Wayland is announced in the environment and answers. Never throws. If true, the
/// connection stays open until the program ends. Main thread only.
bool display_available();

struct WindowOptions {
    std::string title = "Rowland";
    glm::ivec2 size{1280, 720};  ///< screen coordinates, each >= 1
    bool vsync = true;
    bool debug = debug_build();  ///< a debug context: the driver reports errors through KHR_debug (gpu/context.h)
    std::string gpu{};           ///< as HeadlessOptions::gpu
};

/// A window with an OpenGL 4.5 core context, which is current on the thread that made it. All members are for the main
/// thread; several windows may be open at once. System failures throw Error (system).
///
///     InputState input;
///     while (!window.should_close()) {
///         window.poll(input);
///         ...                      // simulate, draw at window.framebuffer_size()
///         window.swap();
///     }
class Window {
 public:
    using DropHandler = std::function<void(const std::vector<std::filesystem::path>&)>;

    /// Throws Error (system) that names what is missing if there is no display, no OpenGL 4.5 core, or if the display
    /// does not draw on the GPU that is asked for; and Error (input) that lists the GPUs if none is the one asked for.
    explicit Window(const WindowOptions& options = {});
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    void make_current();
    /// Shows what was drawn; waits for the display if vsync is on.
    void swap();

    /// The input since the last poll, in order and as much as one frame takes (events_of_one_frame()), and then the
    /// state of the game pad. Calls the drop handler first for dropped files, and passes on what it throws.
    std::vector<InputEvent> poll_events();
    /// Waits until something happens to a window (input, exposure, another size), at most `limit` (> 0), and not at all
    /// if the last poll left input. False if nothing happened.
    bool wait(std::chrono::milliseconds limit);
    /// Starts a frame of `input` and feeds it poll_events().
    void poll(InputState& input);
    /// Called from a poll with the files of each drop; empty: drops are ignored.
    void set_drop_handler(DropHandler handler);

    bool should_close() const;
    void request_close(bool close = true);
    void set_title(const std::string& title);

    glm::ivec2 size() const;  ///< screen coordinates, which the mouse has too
    /// Pixels to render: `size` times the display's scale; 0 x 0 while minimised, when there is nothing to draw.
    glm::ivec2 framebuffer_size() const;
    glm::vec2 content_scale() const;         ///< by which to enlarge text and controls
    glm::ivec2 position() const;             ///< of the content on the desktop; 0, 0 where that is unknown (Wayland)
    void set_position(glm::ivec2 position);  ///< no effect where windows cannot place themselves (Wayland)
    /// Asks for a new size, each >= 1; the display may grant another one, later.
    void resize(glm::ivec2 size);
    bool focused() const;

    bool fullscreen() const;
    /// True: fills the monitor that shows most of the window, in the mode it has. False: restores position and size.
    void set_fullscreen(bool on);

    bool cursor_captured() const;
    /// Hides the cursor and keeps it in the window, for looking around. InputState sees no jump at begin and end.
    void set_cursor_captured(bool captured);

    /// For user interface libraries that attach to GLFW. Callbacks installed later must call the ones they replace.
    GLFWwindow* native() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rowland::platform
