#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "content/demo/options.h"
#include "content/demo/session.h"
#include "engine/post/ocio_config.h"

namespace rowland::demo {

/// Renders without a window and writes what the options ask for: a benchmark, a recording played back, captures, or
/// else a flight through the scene's views. Throws Error.
void run_offscreen(const Options& options, const post::OcioConfig& config);

/// Flies once around the scene in so many frames, 1/30 s of the scene's time apart, each finished before the next.
/// Returns the report: "device" (as given), "width", "height", "frame" (time from the first command to the last pixel),
/// "times_plain" (cost of gratings: ratio to the frame without them), "passes" (in their order), "drawn" and "culled"
/// (objects in the last frame), "baked" (sources that the program had to bake). The first frames, which compile and
/// upload, are not counted.
nlohmann::ordered_json fly_around(Session& session, int frames, const std::string& device);

}  // namespace rowland::demo
