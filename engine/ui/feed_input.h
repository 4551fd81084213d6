#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "engine/platform/input.h"

struct ImGuiIO;

namespace rowland::ui {

/// Tells ImGui which keys edit text and move through controls. ImGui then uses our key numbers.
void map_keys(ImGuiIO& io);

/// Passes a frame's keys, text and mouse to ImGui, which takes one state of each per frame. At low frame rates no click
/// or drag is lost: a button pressed and released within a frame is down in it, at the position of the press; a drag
/// within it moves in the next frame and is released in the one after.
class InputFeed {
 public:
    void feed(const platform::InputState& input, ImGuiIO& io);

 private:
    void feed_mouse(const platform::InputState& input, ImGuiIO& io);

    std::array<bool, 3> down_{};  ///< mouse buttons, as last passed
    glm::dvec2 seen_{0.0};        ///< mouse position, as last passed
};

}  // namespace rowland::ui
