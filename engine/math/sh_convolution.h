#pragma once

namespace rowland::math {

/// Factor A_l by which convolution with the clamped cosine max(0, cos θ) multiplies band l ≥ 0 of radiance, which gives
/// irradiance: A_0 = π, A_1 = 2π/3, A_2 = π/4, A_3 = 0, A_4 = −π/24, ... and 0 for every odd l > 1
/// [Ramamoorthi & Hanrahan 2001, eq. 8]. Exact closed form for any l, to rounding.
double clamped_cosine_factor(int l);

}  // namespace rowland::math
