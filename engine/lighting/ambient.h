#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>

#include "engine/lighting/key_lights.h"
#include "engine/lighting/sh_light.h"
#include "engine/math/sh_window.h"

namespace rowland::lighting {

/// The band factors that keep irradiance from going negative.
struct AmbientWindow {
    math::SphericalWindow window = math::SphericalWindow::None;
    double damping = 0;  ///< if > 0: exp(−damping·l(l+1)) in place of `window`
};

/// 9 SH coefficients of E(n)/π, the radiance that a white diffuse surface of normal n reflects. Linear Rec.709 RGB,
/// world axes, index l(l+1)+m.
struct AmbientLight {
    std::array<glm::dvec3, 9> coefficients = {};
    AmbientWindow window;
};

/// The first three bands convolved with the clamped cosine, under the weakest window (none, Lanczos or Hann over three
/// bands, then exponentials of growing strength) that keeps E non-negative in every direction of a dense set. Missing
/// bands count as zeros.
/// `keys`: lobes that are added to `light`, as irradiance() has them. Then only the sum must not go negative: a
/// residual may.
AmbientLight ambient_coefficients(const ShLight& light, std::span<const KeyLight> keys = {});

}  // namespace rowland::lighting
