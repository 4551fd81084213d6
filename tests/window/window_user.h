#pragma once

#include <functional>
#include <glm/vec2.hpp>

#include "tests/support/virtual_display.h"

namespace rowland::test {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

/// Asks every few milliseconds until `done` is true; false if that takes longer than `limit`.
bool wait_until(const std::function<bool()>& done, std::chrono::seconds limit);

/// The program that an environment variable names in place of the one that was built here: of another system, say.
std::string program_to_try(const char* variable, const char* built);

/// A program in a window of a virtual display, and its user with mouse and keyboard. Positions are pixels from the
/// window's upper left corner; keys are named as xdotool names them ("ctrl+z").
class WindowUser {
 public:
    /// Starts the program and waits for its window.
    WindowUser(glm::ivec2 screen, const Command& program, const std::string& title, Surroundings surroundings = {});

    void key(const std::string& name);
    void hold_key(const std::string& name);
    void release_key(const std::string& name);
    void type(const std::string& text);

    void move_to(glm::ivec2 position);
    void move_by(glm::ivec2 distance);
    void press();
    void release();
    /// Moves the pressed mouse by `distance` in so many moves, with a pause between two, and releases it at once.
    void release_in_motion(glm::ivec2 distance, int moves, std::chrono::milliseconds pause);

    /// Drops a file onto the window, as a file manager does.
    void drop(const std::filesystem::path& file);
    std::string title() const;

    Running& program() { return program_; }
    const Running& program() const { return program_; }

 private:
    /// Runs xdotool; returns what it printed.
    std::string act(Command arguments) const;
    Surroundings on_display(Surroundings surroundings) const;

    VirtualDisplay display_;
    Running program_;
    std::string window_;  ///< its number
};

}  // namespace rowland::test
