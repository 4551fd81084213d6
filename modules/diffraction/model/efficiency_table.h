#pragma once

#include <vector>

namespace rowland::diffraction {

/// The efficiencies of one angle of incidence: a row per wavelength, a column per order of the table.
struct EfficiencySlice {
    double incidence_deg = 0.0;          ///< signed: positive where the light comes from +g, s_g = sin(incidence)
    std::vector<double> wavelengths_nm;  ///< ascending, at least one
    std::vector<double> efficiencies;    ///< row by row, each ≥ 0, rows summing to at most 1 + kRowSumTolerance
};

/// Order efficiencies from a measurement or a rigorous solver; they include the metal (PHYSICS §3).
struct EfficiencyTable {
    std::vector<int> orders;              ///< ascending; all others are 0
    std::vector<EfficiencySlice> slices;  ///< ascending incidence, at least one
};

/// How far a row's sum may exceed 1 by rounding; such rows are scaled to 1.
inline constexpr double kRowSumTolerance = 1e-3;

/// η_m(λ) for light from s_g, |s_g| ≤ 1. Linear in wavelength, and in the angle of incidence if the table has several;
/// constant beyond the table's ends.
///
/// Never interpolated across a cut-off. An order is cut off after its last non-zero row if zeros follow: the value of
/// that row holds up to the wavelength λ_c at which the order turns evanescent, d (1 ± s_g)/|m|, or up to the next row
/// if λ_c is not between the two; beyond, the value is 0. A row at λ_c itself is ignored: solvers print 0 or the limit
/// there. Between a slice that has the order and one that has not, the former's value holds while the order propagates.
/// Held values are no means of rows, so the orders may sum to more than 1: then all are scaled to a sum of 1.
double table_efficiency(const EfficiencyTable& table, double pitch_nm, int order, double wavelength_nm, double s_g);

}  // namespace rowland::diffraction
