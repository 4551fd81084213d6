#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "content/demo/session.h"

namespace rowland::demo {

/// Flies once around the scene in so many frames, 1/30 s of the scene's time apart, each finished before the next.
/// Returns the report: "device" (as given), "width", "height", "frame" (time from the first command to the last pixel),
/// "times_plain" (cost of gratings: ratio to the frame without them), "passes" (in their order), "drawn" and "culled"
/// (objects in the last frame). The first frames, which compile and upload, are not counted.
nlohmann::ordered_json fly_around(Session& session, int frames, const std::string& device);

}  // namespace rowland::demo
