#pragma once

#include "engine/lighting/sh_light.h"
#include "engine/math/sh_window.h"

namespace rowland::diffraction {

/// How much a grating under this band-limited light would ring: of the light that half circles around the grating
/// vector gather (flat lobe), the share that comes out negative, averaged over a fixed set of tangent frames. In [0,
/// 1].
double ringing(const lighting::ShLight& light);

/// Ringing up to this share does not show as dark patches on a disc: seen on pictures under captured and made-up probes
/// (captures of indoor and outdoor light 0 … 0.03, a single lamp in a dark room 0.27 without a window, 0.02 with
/// Lanczos').
inline constexpr double kTolerableRinging = 0.03;

/// The mildest of none, Lanczos and Hann under which the light in `bands` bands rings tolerably; Hann if none does.
math::SphericalWindow mildest_window(const lighting::ShLight& light, int bands);

}  // namespace rowland::diffraction
