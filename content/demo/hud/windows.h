#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "content/demo/hud/panel.h"
#include "engine/gpu/pass_times.h"
#include "engine/platform/frame_pacing.h"

namespace rowland::demo {

/// F1: every control and what it does.
void help_window(bool& open);

/// F10: the times of the last frames, and of the last one's passes on CPU and GPU.
void frame_window(const platform::FrameTimes& times, const std::vector<gpu::PassTime>& passes, bool& open);

/// The grating under the cursor.
struct PixelTarget {
    std::string object;
    std::string look;
    std::string refusal;  ///< why it is not measured; empty if it is
};
/// The error of the pixel under the cursor. True if the user wants the reading written to a file.
bool pixel_window(const PixelTarget* target, const PixelMeter& meter, const glm::dmat3& xyz_to_working);

/// The line between two looks, at `line` of the width, and their names beside it. Returns its position while dragged.
std::optional<double> wipe_line(float line, const std::string& left, const std::string& right);

/// A line at the bottom with the most important keys.
void hint_line();

/// Memory that the process has in use; 0 where the system does not say.
std::size_t resident_bytes();

/// "812 B", "3.4 KiB", "56 MiB": three digits at most before the unit.
std::string readable_bytes(std::size_t bytes);

}  // namespace rowland::demo
