#pragma once

#include <string_view>

namespace rowland::math {

/// Windows against ringing, the weakest first. A window multiplies band l of band-limited light by a factor that falls
/// from 1 at l = 0; it trades peak height for undershoot [Sloan 2008, "Stupid SH tricks", windowing].
enum class SphericalWindow { None, Lanczos, Hann };

/// "none", "lanczos" or "hann".
const char* window_name(SphericalWindow window);
/// Inverse of window_name. The name must be one of the three.
SphericalWindow parse_window(std::string_view name);

/// Factor of band l, 0 ≤ l < bands: 1, sin(πl/n)/(πl/n) or (1 + cos(πl/n))/2 with n = bands. A point light of 5 bands
/// peaks at 1.99, 1.05 and 0.82.
double window_factor(SphericalWindow window, int l, int bands);

/// exp(−damping·l(l+1)), damping ≥ 0: the window of heat diffusion on the sphere.
double exponential_window_factor(double damping, int l);

}  // namespace rowland::math
