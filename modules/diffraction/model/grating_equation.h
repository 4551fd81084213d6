#pragma once

#include <optional>
#include <span>
#include <vector>

namespace rowland::diffraction {

/// The highest order that may be named, ± this.
inline constexpr int kHighestOrder = 10000;

/// The direction cosine v_g = mλ/d − s_g under which order m of wavelength λ leaves a grating of pitch d for light from
/// s_g (PHYSICS §2: d (s_g + v_g) = mλ). Nothing if the order is evanescent, |v_g| > 1.
std::optional<double> diffracted_cosine(double s_g, int order, double wavelength_nm, double pitch_nm);

/// True if some pair of directions shows the order: |m| λ < 2d.
bool propagates(int order, double wavelength_nm, double pitch_nm);

/// One order's wavelength for a pair of directions.
struct Peak {
    int order = 0;
    double wavelength_nm = 0.0;
};

/// The paper's adaptive sampling (Lindsay & Agu 2006, §3.1): for u = s_g + v_g, every order of `orders` but 0 whose one
/// wavelength λ = d u/m is visible (380–780 nm), in the order of the list. u = 0, the mirror, has none.
std::vector<Peak> visible_peaks(double u, double pitch_nm, std::span<const int> orders);

/// Every order but 0 that propagates for some visible wavelength: ascending.
/// Empty for pitches up to 190 nm.
std::vector<int> all_orders(double pitch_nm);

}  // namespace rowland::diffraction
