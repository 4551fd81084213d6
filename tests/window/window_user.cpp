#include "tests/window/window_user.h"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include "engine/core/system.h"

namespace rowland::test {

bool wait_until(const std::function<bool()>& done, std::chrono::seconds limit) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!done()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(20ms);
    }
    return true;
}

std::string program_to_try(const char* variable, const char* built) {
    return environment_variable(variable).value_or(built);
}

WindowUser::WindowUser(glm::ivec2 screen, const Command& program, const std::string& title, Surroundings surroundings)
    : display_(screen.x, screen.y), program_(program, on_display(std::move(surroundings))) {
    const bool found = wait_until(
        [&] {
            std::istringstream windows(act({"search", "--onlyvisible", "--name", title}));
            return static_cast<bool>(windows >> window_) || !program_.alive();
        },
        60s);
    if (!found || window_.empty()) throw std::runtime_error("no window '" + title + "': " + program_.err());
    act({"windowmove", window_, "0", "0", "windowfocus", "--sync", window_});
}

Surroundings WindowUser::on_display(Surroundings surroundings) const {
    surroundings.environment["DISPLAY"] = display_.name();
    surroundings.environment["WAYLAND_DISPLAY"] = std::nullopt;
    return surroundings;
}

std::string WindowUser::act(Command arguments) const {
    arguments.insert(arguments.begin(), {"/usr/bin/env", "xdotool"});
    return run(arguments, on_display({})).out;
}

void WindowUser::key(const std::string& name) {
    act({"key", name});
}
void WindowUser::hold_key(const std::string& name) {
    act({"keydown", name});
}
void WindowUser::release_key(const std::string& name) {
    act({"keyup", name});
}
void WindowUser::type(const std::string& text) {
    act({"type", "--delay", "10", text});
}

void WindowUser::move_to(glm::ivec2 position) {
    act({"mousemove", "--window", window_, std::to_string(position.x), std::to_string(position.y)});
}
void WindowUser::move_by(glm::ivec2 distance) {
    act({"mousemove_relative", "--", std::to_string(distance.x), std::to_string(distance.y)});
}
void WindowUser::press() {
    act({"mousedown", "1"});
}
void WindowUser::release() {
    act({"mouseup", "1"});
}

void WindowUser::release_in_motion(glm::ivec2 distance, int moves, std::chrono::milliseconds pause) {
    // By one process: on a busy machine the start of another would be a rest before the release.
    Command steps;
    for (int i = 0; i < moves; ++i) {
        if (i > 0)
            steps.insert(steps.end(), {"sleep", fmt::format("{:.3f}", std::chrono::duration<double>(pause).count())});
        const glm::ivec2 step = distance * (i + 1) / moves - distance * i / moves;
        steps.insert(steps.end(), {"mousemove_relative", "--", std::to_string(step.x), std::to_string(step.y)});
    }
    steps.insert(steps.end(), {"mouseup", "1"});
    act(steps);
}

void WindowUser::drop(const std::filesystem::path& file) {
    const Ended dropped = run({ROWLAND_DROP_FILES, window_, file.string()}, on_display({}));
    if (dropped.code != 0) throw std::runtime_error(file.string() + " was not taken: " + dropped.err);
}

std::string WindowUser::title() const {
    return act({"getwindowname", window_});
}

}  // namespace rowland::test
