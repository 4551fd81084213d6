#include "engine/platform/glfw.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "engine/platform/input.h"

namespace rowland::platform {

std::shared_ptr<GlfwLibrary> GlfwLibrary::acquire(std::string& reason) {
    // GLFW is one per process and so is the count of its holders.
    static std::weak_ptr<GlfwLibrary> running;
    if (auto held = running.lock()) return held;
    if (glfwInit() != GLFW_TRUE) {
        reason = take_glfw_error();
        return nullptr;
    }
    std::shared_ptr<GlfwLibrary> library(new GlfwLibrary);
    running = library;
    return library;
}

GlfwLibrary::~GlfwLibrary() {
    glfwTerminate();
}

std::string take_glfw_error() {
    const char* description = nullptr;
    const bool failed = glfwGetError(&description) != GLFW_NO_ERROR;
    return failed && description != nullptr ? description : "";
}

namespace {

// Both enumerations list the pad's buttons in the same order.
static_assert(static_cast<int>(GamepadButton::North) == GLFW_GAMEPAD_BUTTON_Y);
static_assert(static_cast<int>(GamepadButton::Left) == GLFW_GAMEPAD_BUTTON_LAST);
static_assert(static_cast<int>(GamepadButton::Count) == GLFW_GAMEPAD_BUTTON_LAST + 1);

WindowEvents& events_of(GLFWwindow* window) {
    return *static_cast<WindowEvents*>(glfwGetWindowUserPointer(window));
}

void on_key(GLFWwindow* window, int key, int /*scancode*/, int action, int /*mods*/) {
    // Repeats are for typed text.
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

}  // namespace

std::optional<MouseButton> mouse_button_of_glfw(int button) {
    switch (button) {
        case GLFW_MOUSE_BUTTON_LEFT:
            return MouseButton::Left;
        case GLFW_MOUSE_BUTTON_RIGHT:
            return MouseButton::Right;
        case GLFW_MOUSE_BUTTON_MIDDLE:
            return MouseButton::Middle;
        default:
            return std::nullopt;
    }
}

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

GamepadEvent read_gamepad() {
    GLFWgamepadstate state{};
    int joystick = GLFW_JOYSTICK_1;
    while (joystick <= GLFW_JOYSTICK_LAST && glfwGetGamepadState(joystick, &state) != GLFW_TRUE) ++joystick;
    if (joystick > GLFW_JOYSTICK_LAST) return {};

    GamepadEvent event{.connected = true, .axes = {}, .buttons = {}};
    // GLFW's sticks grow downwards and its triggers go from -1.
    const auto stick = [&](int axis) { return state.axes[axis]; };
    const auto trigger = [&](int axis) { return 0.5F * (state.axes[axis] + 1.0F); };
    event.axes = {stick(GLFW_GAMEPAD_AXIS_LEFT_X),         -stick(GLFW_GAMEPAD_AXIS_LEFT_Y),
                  stick(GLFW_GAMEPAD_AXIS_RIGHT_X),        -stick(GLFW_GAMEPAD_AXIS_RIGHT_Y),
                  trigger(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER), trigger(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER)};
    for (std::size_t i = 0; i < event.buttons.size(); ++i) event.buttons[i] = state.buttons[i] == GLFW_PRESS;
    return event;
}

}  // namespace rowland::platform
