#pragma once

#include <deque>
#include <optional>
#include <string>

#include "content/demo/hud/panel.h"
#include "engine/gpu/pass_times.h"

namespace rowland::demo {

/// F1: every control and what it does, from the tables that read them.
void help_window(bool& open);

/// F10: the times of the last frames, and of the passes of the last one on both processors.
void frame_window(const std::deque<float>& frame_ms, const std::vector<gpu::PassTime>& passes, bool& open);

/// The grating under the cursor.
struct PixelTarget {
    std::string object;
    std::string look;
    std::string refusal;  ///< why it is not measured; empty if it is
};
/// How far the pixel under the cursor is from the reference. True if the reading is to be written to a file.
bool pixel_window(const PixelTarget* target, const PixelMeter& meter, const glm::dmat3& xyz_to_working);

/// The line between two looks, at a share of the width, and their names beside it. Where it is dragged to, if it is.
std::optional<double> wipe_line(float line, const std::string& left, const std::string& right);

/// A line at the bottom that says where help is.
void hint_line();

}  // namespace rowland::demo
