#pragma once

#include "engine/scene/camera.h"

namespace rowland::demo {

/// The camera of a flight once around `start`'s target: at `share` 0 and 1 it is `start`; on the way it comes down to
/// grazing views and rises above the scene.
scene::Camera flight(const scene::Camera& start, double share);

}  // namespace rowland::demo
