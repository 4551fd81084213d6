#pragma once

#include <string>

#include "content/demo/play/play.h"

namespace rowland::demo {

/// A short text that two plays share only if every object, light and the camera stand the same to the bit, and their
/// times and steps are equal.
std::string fingerprint(Play& play);

}  // namespace rowland::demo
