#pragma once

#include <vector>

#include "engine/scene/camera.h"

namespace rowland::demo {

/// The camera of a flight from the first view by way of all others to the last one, smooth and with the same time
/// between any two; `share` in 0 to 1. A single view is flown once around. There must be one.
scene::Camera tour(const std::vector<scene::Camera>& views, double share);

}  // namespace rowland::demo
