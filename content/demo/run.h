#pragma once

#include "content/demo/options.h"
#include "engine/post/ocio_config.h"

namespace rowland::demo {

/// Renders without a window and writes what the options ask for: a benchmark, a recording played back, captures, or
/// else a flight through the scene's views. Throws Error.
void run_offscreen(const Options& options, const post::OcioConfig& config);

/// Opens the demo in a window and runs it until it is closed. Needs a display (platform::display_available()).
void run_in_window(const Options& options, const post::OcioConfig& config);

}  // namespace rowland::demo
