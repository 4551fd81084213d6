#pragma once

#include <glm/vec3.hpp>

#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// Agu's BRDF as the paper prints it (Lindsay & Agu 2006, eq. 1–3): f_A = I₀ sinc²(b u/λ) F_N(d u/λ), u = s_g + v_g,
/// for unit vectors s, v in the frame (g, h, n). The profile must be a slit. No metal, no list of orders.
double brdf_agu(const Grating& grating, const glm::dvec3& s, const glm::dvec3& v, double wavelength_nm,
                double peak_intensity = 1.0);

/// The energy-preserving BRDF at one pair of directions, with the true width of N grooves (PHYSICS §3):
/// f_E = η_m(λ) (N d/λ) F_N(d u/λ) D_h(s_h + v_h), m the order nearest to d u/λ; 0 if m is not listed, propagates
/// nowhere, or a direction is below the surface. Under kManyGrooves grooves the groove's own spectrum takes η_m's
/// place. Reciprocal; with a table of several incidences, as far as the table is. With the "agu" normalisation
/// order_efficiency()'s factor is included.
double brdf_energy(const Grating& grating, const glm::dvec3& s, const glm::dvec3& v, double wavelength_nm);

/// f_A/f_E at a peak of a slit with the flat lobe: 2λ/(N d (b/d)²), for peak_intensity 1.
double agu_to_energy_ratio(const Grating& grating, double wavelength_nm);

}  // namespace rowland::diffraction
