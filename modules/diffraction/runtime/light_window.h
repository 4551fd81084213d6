#pragma once

#include "engine/lighting/sh_light.h"
#include "engine/math/sh_window.h"

namespace rowland::diffraction {

/// Ringing of a grating under this band-limited light: the negative fraction of the light that half circles around the
/// grating vector gather (flat lobe), averaged over a fixed set of tangent frames. In [0, 1].
double ringing(const lighting::ShLight& light);

/// Ringing up to this does not show as dark patches on a disc, judged on images under captured and synthetic probes.
/// Captures of indoor and outdoor light have 0 … 0.03, a single lamp in a dark room 0.27, with Lanczos 0.02.
inline constexpr double kTolerableRinging = 0.03;

/// The weakest of none, Lanczos and Hann under which the light in `bands` bands rings tolerably; Hann if none does.
math::SphericalWindow weakest_window(const lighting::ShLight& light, int bands);

}  // namespace rowland::diffraction
