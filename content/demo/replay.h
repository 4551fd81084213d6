#pragma once

#include <optional>
#include <string>

#include "content/demo/options.h"
#include "content/demo/play/recording.h"

namespace rowland::demo {

class Play;

/// What the options show, by the name that a recording stores.
std::string scene_name(const Options& options);

/// The recording that the options name, if they name one. Throws Error (input) if it is damaged or was made with
/// another scene.
std::optional<Recording> recording_for(const Options& options);

/// Logs the step count and fingerprint of a play. A recording and its playback end with the same line.
void log_state(const Play& play);

}  // namespace rowland::demo
