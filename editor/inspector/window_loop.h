#pragma once

#include "editor/inspector/options.h"
#include "engine/post/ocio_config.h"

namespace rowland::inspector {

/// Opens the inspector in a window and runs it until it is closed. Needs a display (platform::display_available()).
void run_in_window(const Options& options, const post::OcioConfig& config);

}  // namespace rowland::inspector
