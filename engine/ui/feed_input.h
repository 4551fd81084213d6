#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "engine/platform/input.h"

struct ImGuiIO;

namespace rowland::ui {

/// Tells ImGui which of our keys edit text and move through controls. Its numbers for keys are then ours.
void map_keys(ImGuiIO& io);

/// Hands a frame's keys, text and mouse to ImGui, which sees one state of each a frame. So that no click or drag is
/// lost at a low frame rate, what was pressed and let go within a frame counts as down in it; a press is seen where it
/// was made; and what was dragged meanwhile moves in the next frame, and is let go in the one after it.
class InputFeed {
 public:
    void feed(const platform::InputState& input, ImGuiIO& io);

 private:
    void feed_mouse(const platform::InputState& input, ImGuiIO& io);

    std::array<bool, 3> down_{};  ///< mouse buttons, as ImGui saw them last
    glm::dvec2 seen_{0.0};        ///< and the mouse
};

}  // namespace rowland::ui
