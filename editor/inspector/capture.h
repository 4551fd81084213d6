#pragma once

#include "editor/inspector/options.h"
#include "engine/post/ocio_config.h"

namespace rowland::inspector {

/// Writes the window that the options ask for as PNG, once everything in it is computed. Needs no display.
void capture(const Options& options, const post::OcioConfig& config);

}  // namespace rowland::inspector
