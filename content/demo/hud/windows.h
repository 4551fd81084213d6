#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "content/demo/hud/panel.h"
#include "engine/gpu/pass_times.h"
#include "engine/platform/frame_pacing.h"

namespace rowland::demo {

/// Draws the window that lists every control.
void help_window(bool& open);

/// Draws recent frame times, and the CPU and GPU time of each pass of the latest frame.
void frame_window(const platform::FrameTimes& times, const std::vector<gpu::PassTime>& passes, bool& open);

/// The grating under the cursor.
struct PixelTarget {
    std::string object;
    std::string representation;
    std::string refusal{};  ///< why it is not measured; empty if it is
};
/// Draws the error of the pixel under the cursor; without a target, a hint. Returns whether "write" was pressed.
bool pixel_window(const PixelTarget* target, const PixelMeter& meter, const glm::dmat3& xyz_to_working);

/// Draws the line between two representations, at the fraction `line` of the width, and their names beside it. Returns
/// the line's new position, 0 to 1, while it is dragged, else nullopt.
std::optional<double> wipe_handle(float line, const std::string& left, const std::string& right);

/// Draws a line at the bottom with the most important keys.
void key_hints();

/// "812 B", "3.4 KiB", "56 MiB": at most three significant digits.
std::string format_bytes(std::size_t bytes);

}  // namespace rowland::demo
