#pragma once

#include <vector>

#include "engine/scene/camera.h"

namespace rowland::demo {

/// The camera of a flight once around `start`'s target, `progress` in 0 to 1. It begins and ends at `start`; on the way
/// it comes down to grazing views and rises above the scene.
scene::Camera flight(const scene::Camera& start, double progress);

/// The camera of a smooth flight through all views, of which there must be one. The time between any two is the same.
/// A single view is flown around.
scene::Camera tour(const std::vector<scene::Camera>& views, double progress);

}  // namespace rowland::demo
