#include "engine/platform/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/gpu/pipeline_state.h"
#include "engine/platform/display.h"
#include "engine/platform/gl_context.h"

namespace rowland::platform {

namespace {

std::int64_t common_area(const ScreenArea& a, const ScreenArea& b) {
    const glm::ivec2 low = glm::max(a.position, b.position);
    const glm::ivec2 high = glm::min(a.position + a.size, b.position + b.size);
    const glm::ivec2 size = glm::max(high - low, glm::ivec2(0));
    return std::int64_t{size.x} * size.y;
}

}  // namespace

std::size_t monitor_showing(const ScreenArea& window, std::span<const ScreenArea> monitors) {
    std::size_t best = 0;
    std::int64_t largest = 0;
    for (std::size_t i = 0; i < monitors.size(); ++i) {
        const std::int64_t area = common_area(window, monitors[i]);
        if (area <= largest) continue;
        largest = area;
        best = i;
    }
    return best;
}

namespace {

/// Returns and clears GLFW's last error; empty if there was none.
std::string take_glfw_error() {
    const char* description = nullptr;
    const bool failed = glfwGetError(&description) != GLFW_NO_ERROR;
    return failed && description != nullptr ? description : "";
}

}  // namespace

/// GLFW is initialised while someone holds this. Main thread only.
class GlfwLibrary {
 public:
    /// Initialises GLFW if nobody holds it; null if that fails, with GLFW's reason in `reason`.
    static std::shared_ptr<GlfwLibrary> acquire(std::string& reason) {
        // GLFW is one per process and so is the count of its holders.
        static std::weak_ptr<GlfwLibrary> running;
        if (auto held = running.lock()) return held;
        if (glfwInit() != GLFW_TRUE) {
            reason = take_glfw_error();
            return nullptr;
        }
        survive_display_errors();
        std::shared_ptr<GlfwLibrary> library(new GlfwLibrary);
        running = library;
        return library;
    }
    ~GlfwLibrary() { glfwTerminate(); }
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;

 private:
    GlfwLibrary() = default;
};

/// What happened in a window since the last poll.
struct WindowEvents {
    std::vector<InputEvent> input;
    std::vector<std::vector<std::filesystem::path>> drops;  ///< the files of each drop
    bool exposed = false;                                   ///< the window's content is lost
};

namespace {

// Both enumerations list the pad's buttons in the same order.
static_assert(static_cast<int>(GamepadButton::North) == GLFW_GAMEPAD_BUTTON_Y);
static_assert(static_cast<int>(GamepadButton::Left) == GLFW_GAMEPAD_BUTTON_LAST);
static_assert(static_cast<int>(GamepadButton::Count) == GLFW_GAMEPAD_BUTTON_LAST + 1);

WindowEvents& events_of(GLFWwindow* window) {
    return *static_cast<WindowEvents*>(glfwGetWindowUserPointer(window));
}

void on_key(GLFWwindow* window, int key, int /*scancode*/, int action, int /*mods*/) {
    // Repeats matter for typed text only, which has its own callback.
    const std::optional<Key> known = key_of_glfw(key);
    if (known && action != GLFW_REPEAT) events_of(window).input.push_back(KeyEvent{*known, action == GLFW_PRESS});
}

void on_mouse_button(GLFWwindow* window, int button, int action, int /*mods*/) {
    const std::optional<MouseButton> known = mouse_button_of_glfw(button);
    if (known) events_of(window).input.push_back(MouseButtonEvent{*known, action == GLFW_PRESS});
}

void on_drop(GLFWwindow* window, int count, const char** paths) {
    std::vector<std::filesystem::path>& files = events_of(window).drops.emplace_back();
    // GLFW's paths are UTF-8 on every system.
    for (int i = 0; i < count; ++i) files.emplace_back(reinterpret_cast<const char8_t*>(paths[i]));
}

/// Appends what happens in `window` to `events`, which becomes the window's user pointer and must outlive the window.
void collect_events(GLFWwindow* window, WindowEvents& events) {
    glfwSetWindowUserPointer(window, &events);
    glfwSetKeyCallback(window, on_key);
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned codepoint) {
        events_of(w).input.push_back(CharEvent{static_cast<char32_t>(codepoint)});
    });
    glfwSetMouseButtonCallback(window, on_mouse_button);
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
        events_of(w).input.push_back(MouseMoveEvent{{x, y}});
    });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
        events_of(w).input.push_back(ScrollEvent{{x, y}});
    });
    glfwSetWindowFocusCallback(
        window, [](GLFWwindow* w, int focused) { events_of(w).input.push_back(FocusEvent{focused == GLFW_TRUE}); });
    glfwSetDropCallback(window, on_drop);
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { events_of(w).exposed = true; });
}

/// The first game pad whose layout GLFW knows; not connected if there is none.
GamepadEvent read_gamepad() {
    GLFWgamepadstate state{};
    int joystick = GLFW_JOYSTICK_1;
    while (joystick <= GLFW_JOYSTICK_LAST && glfwGetGamepadState(joystick, &state) != GLFW_TRUE) ++joystick;
    if (joystick > GLFW_JOYSTICK_LAST) return {};

    GamepadEvent event{.connected = true, .axes = {}, .buttons = {}};
    // GLFW's y axes of sticks point down, and its triggers go from -1 to 1.
    const auto stick = [&](int axis) { return state.axes[axis]; };
    const auto trigger = [&](int axis) { return 0.5F * (state.axes[axis] + 1.0F); };
    event.axes = {stick(GLFW_GAMEPAD_AXIS_LEFT_X),         -stick(GLFW_GAMEPAD_AXIS_LEFT_Y),
                  stick(GLFW_GAMEPAD_AXIS_RIGHT_X),        -stick(GLFW_GAMEPAD_AXIS_RIGHT_Y),
                  trigger(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER), trigger(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER)};
    for (std::size_t i = 0; i < event.buttons.size(); ++i) event.buttons[i] = state.buttons[i] == GLFW_PRESS;
    return event;
}

[[noreturn]] void fail(const std::string& doing, const std::string& reason, std::string expected, std::string remedy) {
    throw Error({.file = "window",
                 .location = doing,
                 .found = reason.empty() ? "GLFW failed without a reason" : reason,
                 .expected = std::move(expected),
                 .remedy = std::move(remedy),
                 .fault = Fault::System});
}

std::shared_ptr<GlfwLibrary> require_library() {
    std::string reason;
    auto library = GlfwLibrary::acquire(reason);
    if (!library) {
        fail("starting GLFW", reason, "a display (X11 or Wayland) that answers",
             "set DISPLAY or WAYLAND_DISPLAY, or run without a window");
    }
    return library;
}

GLFWwindow* open(const WindowOptions& options) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
    // Resets of the GPU are reported (gpu/context.h), where the driver can.
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    // The scene is drawn into framebuffer objects with depth and stencil buffers of their own.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    take_glfw_error();
    GLFWwindow* handle = glfwCreateWindow(options.size.x, options.size.y, options.title.c_str(), nullptr, nullptr);
    if (handle == nullptr) {
        fail("opening", take_glfw_error(),
             "a driver with OpenGL 4.5 core (any GPU of the last ten years, or Mesa's llvmpipe)",
             "install the GPU's driver, or Mesa's software renderer (Debian: libgl1-mesa-dri)");
    }
    return handle;
}

struct Monitor {
    GLFWmonitor* handle = nullptr;
    const GLFWvidmode* mode = nullptr;
    glm::ivec2 position{0};
};

/// The monitor that shows most of `window`; its handle is null if there is no monitor at all.
Monitor monitor_of(const ScreenArea& window) {
    int count = 0;
    GLFWmonitor** handles = glfwGetMonitors(&count);
    std::vector<Monitor> monitors;
    std::vector<ScreenArea> areas;
    for (int i = 0; i < count; ++i) {
        Monitor monitor{.handle = handles[i], .mode = glfwGetVideoMode(handles[i])};
        if (monitor.mode == nullptr) continue;
        glfwGetMonitorPos(monitor.handle, &monitor.position.x, &monitor.position.y);
        areas.push_back({monitor.position, {monitor.mode->width, monitor.mode->height}});
        monitors.push_back(monitor);
    }
    return monitors.empty() ? Monitor{} : monitors[monitor_showing(window, areas)];
}

}  // namespace

bool display_available() {
    if (!display_announced()) return false;
    // Kept for the window that is to open: a server that restarts when its last client leaves, as Xvfb does, may
    // refuse the next one.
    static std::shared_ptr<GlfwLibrary> kept;
    std::string reason;
    if (!kept) kept = GlfwLibrary::acquire(reason);
    return kept != nullptr;
}

struct Window::State {
    std::shared_ptr<GlfwLibrary> library = require_library();
    GLFWwindow* handle = nullptr;
    WindowEvents events;
    DropHandler on_drop;
    ScreenArea before_fullscreen;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (handle != nullptr) glfwDestroyWindow(handle);
    }
};

Window::Window(const WindowOptions& options) : state_(std::make_unique<State>()) {
    ROWLAND_CHECK_OP(options.size.x, >=, 1);
    ROWLAND_CHECK_OP(options.size.y, >=, 1);
    const std::string gpu = choose_gpu_of_windows(options.gpu);
    state_->handle = open(options);
    survive_display_errors();
    collect_events(state_->handle, state_->events);
    make_current();
    glfwSwapInterval(options.vsync ? 1 : 0);
    require_gpu_of_window(gpu);
}

Window::~Window() = default;

void Window::make_current() {
    glfwMakeContextCurrent(state_->handle);
    gpu::forget_bound_state();
}

void Window::swap() {
    glfwSwapBuffers(state_->handle);
}

std::vector<InputEvent> Window::poll_events() {
    // One call serves all windows; another window's poll may have left events here.
    glfwPollEvents();
    // If the handler throws, the input waits for the next poll.
    const auto drops = std::exchange(state_->events.drops, {});
    if (state_->on_drop)
        for (const auto& files : drops) state_->on_drop(files);
    std::vector<InputEvent>& all = state_->events.input;
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(events_of_one_frame(all));
    std::vector<InputEvent> events(all.begin(), end);
    all.erase(all.begin(), end);
    events.emplace_back(read_gamepad());
    return events;
}

bool Window::wait(std::chrono::milliseconds limit) {
    if (!state_->events.input.empty()) return true;
    const auto begin = std::chrono::steady_clock::now();
    glfwWaitEventsTimeout(std::chrono::duration<double>(limit).count());
    const bool exposed = std::exchange(state_->events.exposed, false);
    return exposed || std::chrono::steady_clock::now() - begin < limit;
}

void Window::poll(InputState& input) {
    const std::vector<InputEvent> events = poll_events();
    input.begin_frame();
    for (const InputEvent& event : events) input.apply(event);
}

void Window::set_drop_handler(DropHandler handler) {
    state_->on_drop = std::move(handler);
}

bool Window::should_close() const {
    return glfwWindowShouldClose(state_->handle) == GLFW_TRUE;
}

void Window::request_close(bool close) {
    glfwSetWindowShouldClose(state_->handle, close ? GLFW_TRUE : GLFW_FALSE);
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(state_->handle, title.c_str());
}

glm::ivec2 Window::size() const {
    glm::ivec2 size(0);
    glfwGetWindowSize(state_->handle, &size.x, &size.y);
    return size;
}

glm::ivec2 Window::framebuffer_size() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(state_->handle, &size.x, &size.y);
    return size;
}

glm::vec2 Window::content_scale() const {
    glm::vec2 scale(1.0F);
    glfwGetWindowContentScale(state_->handle, &scale.x, &scale.y);
    return scale;
}

glm::ivec2 Window::position() const {
    glm::ivec2 position(0);
    glfwGetWindowPos(state_->handle, &position.x, &position.y);
    return position;
}

void Window::set_position(glm::ivec2 position) {
    glfwSetWindowPos(state_->handle, position.x, position.y);
}

void Window::resize(glm::ivec2 size) {
    ROWLAND_CHECK_OP(size.x, >=, 1);
    ROWLAND_CHECK_OP(size.y, >=, 1);
    glfwSetWindowSize(state_->handle, size.x, size.y);
}

bool Window::focused() const {
    return glfwGetWindowAttrib(state_->handle, GLFW_FOCUSED) == GLFW_TRUE;
}

bool Window::fullscreen() const {
    return glfwGetWindowMonitor(state_->handle) != nullptr;
}

void Window::set_fullscreen(bool on) {
    if (on == fullscreen()) return;
    if (!on) {
        const ScreenArea& area = state_->before_fullscreen;
        glfwSetWindowMonitor(state_->handle, nullptr, area.position.x, area.position.y, area.size.x, area.size.y,
                             GLFW_DONT_CARE);
        return;
    }
    const ScreenArea area{position(), size()};
    const Monitor monitor = monitor_of(area);
    if (monitor.handle == nullptr) {
        fail("going to full screen", take_glfw_error(), "a monitor", "connect one, or stay in the window");
    }
    state_->before_fullscreen = area;
    glfwSetWindowMonitor(state_->handle, monitor.handle, 0, 0, monitor.mode->width, monitor.mode->height,
                         monitor.mode->refreshRate);
}

bool Window::cursor_captured() const {
    return glfwGetInputMode(state_->handle, GLFW_CURSOR) == GLFW_CURSOR_DISABLED;
}

void Window::set_cursor_captured(bool captured) {
    if (captured == cursor_captured()) return;
    glfwSetInputMode(state_->handle, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    state_->events.input.emplace_back(CursorCaptureEvent{captured});
}

GLFWwindow* Window::native() const {
    return state_->handle;
}

}  // namespace rowland::platform
