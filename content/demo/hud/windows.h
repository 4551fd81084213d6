#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "content/demo/hud/panel.h"
#include "engine/gpu/pass_times.h"
#include "engine/platform/frame_pacing.h"

namespace rowland::demo {

/// Every control and what it does.
void help_window(bool& open);

/// Recent frame times, and the CPU and GPU time of each pass of the latest frame.
void frame_window(const platform::FrameTimes& times, const std::vector<gpu::PassTime>& passes, bool& open);

/// The grating under the cursor.
struct PixelTarget {
    std::string object;
    std::string look;
    std::string refusal;  ///< why it is not measured; empty if it is
};
/// The error of the pixel under the cursor. Returns whether "write" was pressed.
bool pixel_window(const PixelTarget* target, const PixelMeter& meter, const glm::dmat3& xyz_to_working);

/// The line between two looks, at `line` of the width, and their names beside it. Returns its position, or nullopt
/// unless dragged.
std::optional<double> wipe_handle(float line, const std::string& left, const std::string& right);

/// A line at the bottom with the most important keys.
void key_hints();

/// Resident set size of the process; 0 where the system does not say.
std::size_t resident_set_bytes();

/// "812 B", "3.4 KiB", "56 MiB": at most three significant digits.
std::string format_bytes(std::size_t bytes);

}  // namespace rowland::demo
