#pragma once

#include <optional>
#include <span>
#include <vector>

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

}  // namespace rowland::diffraction
