#pragma once

#include <glm/vec3.hpp>

#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// Agu's BRDF as the paper prints it (Lindsay & Agu 2006, eq. 1–3): f_A = I₀ sinc²(b u/λ) F_N(d u/λ), u = s_g + v_g,
/// for unit vectors s, v in the frame (g, h, n). The profile must be a slit. No metal, no list of orders.
double brdf_agu(const Grating& grating, const glm::dvec3& s, const glm::dvec3& v, double wavelength_nm,
                double peak_intensity = 1.0);

/// (N/λ) F_N(x/λ) η, per nm of the path difference x: the density in x of the light of wavelength λ. η is the
/// efficiency of the order m nearest to x/λ for light from s_g, or below kManyGrooves grooves the groove's own spectrum
/// at x/λ. 0 if m is not listed or propagates nowhere.
double path_density(const Grating& grating, double path_nm, double wavelength_nm, double s_g = 0.0);

/// The energy-conserving BRDF at one pair of directions, with the true width of N grooves (PHYSICS §3):
/// f_E = d · path_density(d u, λ) · D_h(s_h + v_h) · T(s_n) T(v_n), T of the cover; 0 if a direction is below the
/// surface or, of a sheet's transmitted side, the light is above it. Reciprocal, but for tables of several incidences
/// that are not. With the "agu" normalisation order_efficiency()'s factor is included.
double brdf_energy(const Grating& grating, const glm::dvec3& s, const glm::dvec3& v, double wavelength_nm);

}  // namespace rowland::diffraction
