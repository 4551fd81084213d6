#pragma once

#include <vector>

#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/model/shading_point.h"

namespace rowland::diffraction {

/// The frames that errors are measured at, 120 for each shape: a compact disc tilted by 35° for flat surfaces; for
/// curved ones a sphere with the grooves along its meridians, down to v_n = 0.1.
std::vector<ShadingPoint> measured_frames(SurfaceShape surface);

}  // namespace rowland::diffraction
