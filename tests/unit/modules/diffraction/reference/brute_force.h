#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/lighting/sh_light.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

struct BruteForceSettings {
    int bands = 5;                    ///< 1 to 32
    std::size_t samples = 1'000'000;  ///< about so many directions; at least 1
    std::uint64_t seed = 1;
};

/// The diffraction term's SH coefficients for one view as Lindsay & Agu 2006 (§3) compute them, by sampling the sphere:
/// coefficient i, RGB in, XYZ out, is the mean over directions s of Σ_m η_m(λ_m) (d/|m|) D_h s_n Y_i(s) cmf(λ_m)
/// E(λ_m)ᵀ with the adaptive sampling's one wavelength per order, λ_m = d (s_g + v_g)/m. `view` is a unit vector in the
/// frame (g, h, n). Listed orders but 0, whose δ no sample meets. bands² matrices; 0 for a view below the horizon.
///
/// One jittered direction in each cell of an even grid over the upper hemisphere (the lower sends nothing). The result
/// depends on the settings alone, not on the number of threads. Its error falls at least as 1/√samples. Throws Error
/// (input) for fewer than kManyGrooves grooves, whose orders have no single wavelength.
std::vector<glm::dmat3> brute_force_coefficients(const Grating& grating, const colour::LightSpectra& spectra,
                                                 const glm::dvec3& view, const BruteForceSettings& settings);

/// XYZ of such coefficients under light given in the same frame; the bands that both have are used.
glm::dvec3 brute_force_radiance(const std::vector<glm::dmat3>& coefficients, const lighting::ShLight& tangent_light);

}  // namespace rowland::diffraction
