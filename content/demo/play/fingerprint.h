#pragma once

#include <string>

#include "content/demo/play/play.h"

namespace rowland::demo {

/// A short hash of the pose of every object, light and the camera, to the bit, and of time and steps.
std::string fingerprint(Play& play);

}  // namespace rowland::demo
