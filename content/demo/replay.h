#pragma once

#include <filesystem>
#include <string>

#include "content/demo/options.h"
#include "content/demo/play/recording.h"
#include "content/demo/session.h"

namespace rowland::demo {

/// The name of what the options show, by which a recording knows its scene.
std::string scene_name(const Options& options);

/// Loads the recording that the options name. Throws Error (input) if it is damaged or was made with another scene.
Recording recording_for(const Options& options);

/// Plays it without a window, in frames of 1/30 s and at most as many as the options say. Pictures go where the options
/// name captures, numbered; else the last one is written to the output folder. Says how it ended.
void play_back(Session& session, const Options& options, const Recording& recording);

}  // namespace rowland::demo
