#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// The largest |m| that a file may list.
inline constexpr int kHighestOrder = 10000;

/// The direction cosine v_g = mλ/d − s_g under which order m of wavelength λ leaves a grating of pitch d for light from
/// s_g (PHYSICS §2). nullopt if the order is evanescent, |v_g| > 1.
std::optional<double> diffracted_cosine(double s_g, int order, double wavelength_nm, double pitch_nm);

/// True if the order is visible for some pair of directions: |m| λ < 2d.
bool propagates(int order, double wavelength_nm, double pitch_nm);

/// The wavelength of one order for a pair of directions.
struct Peak {
    int order = 0;
    double wavelength_nm = 0.0;
};

/// The paper's adaptive sampling (Lindsay & Agu 2006, §3.1): for u = s_g + v_g, the orders but 0 whose wavelength
/// λ = d u/m is visible (380–780 nm), in the sequence of `orders`. u = 0, the mirror, has none.
std::vector<Peak> visible_peaks(double u, double pitch_nm, std::span<const int> orders);

/// Every order but 0 that propagates for some visible wavelength, ascending. Empty for pitches up to 190 nm.
std::vector<int> all_orders(double pitch_nm);

/// The Fejér ratio F_N(m + δ) = [sin(πN(m+δ)) / (N sin(π(m+δ)))]², the interference of N grooves, at distance `delta`
/// from any whole order m: 1 at δ = 0, mean 1/N over a period (Lindsay & Agu 2006, eq. 1; PHYSICS §8). `grooves` is a
/// whole number N ≥ 1.
///
/// The order is not a parameter because F_N has period 1, and m + δ would lose digits of δ: in float, the formula at
/// m + δ is off by up to 230 near a peak, where the value is 1. Error of this function: in double 1e-12 relative down
/// to 1e-20, in float 1e-5 absolute.
double fejer(double grooves, double delta);
float fejer(float grooves, float delta);

/// Agu's BRDF as the paper prints it (Lindsay & Agu 2006, eq. 1–3): f_A = I₀ sinc²(b u/λ) F_N(d u/λ), u = s_g + v_g,
/// for unit vectors s, v in the frame (g, h, n). The profile must be a slit. No metal, no list of orders.
double brdf_agu(const Grating& grating, const glm::dvec3& s, const glm::dvec3& v, double wavelength_nm,
                double peak_intensity = 1.0);

/// (N/λ) F_N(x/λ) η, per nm of the path difference x: the density in x of the light of wavelength λ. η is the
/// efficiency of the order m nearest to x/λ for light from s_g, or below kManyGrooves grooves the groove's own spectrum
/// at x/λ. 0 if m is not listed or propagates nowhere.
double path_density(const Grating& grating, double path_nm, double wavelength_nm, double s_g = 0.0);

/// The energy-conserving BRDF at one pair of directions, with the true width of N grooves (PHYSICS §3):
/// f_E = d · path_density(d u, λ) · D_h(s_h + v_h) · T(s_n) T(v_n), T of the cover. 0 if the view is below the surface,
/// or if the light is; of a sheet that transmits, if the light is above it. Reciprocal, except for tables of several
/// incidences that are not. With the "agu" normalisation order_efficiency()'s factor is included.
double brdf_energy(const Grating& grating, const glm::dvec3& s, const glm::dvec3& v, double wavelength_nm);

}  // namespace rowland::diffraction
