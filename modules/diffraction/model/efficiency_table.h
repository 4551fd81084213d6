#pragma once

#include <vector>

namespace rowland::diffraction {

/// The efficiencies of one angle of incidence: a row per wavelength, a column per order of the table.
struct EfficiencySlice {
    double incidence_deg = 0.0;          ///< signed: positive where the light comes from +g, s_g = sin(incidence)
    std::vector<double> wavelengths_nm;  ///< ascending, at least one
    std::vector<double> efficiencies;    ///< row by row, each ≥ 0, rows summing to at most 1 + kRowSumTolerance
};

/// Order efficiencies from a measurement or a rigorous solver, metal included (PHYSICS §3, `table`).
struct EfficiencyTable {
    std::vector<int> orders;              ///< ascending; every other order is 0
    std::vector<EfficiencySlice> slices;  ///< ascending incidence, at least one
};

/// How far above 1 rounding may take a row's sum; what is above 1 is scaled away.
inline constexpr double kRowSumTolerance = 1e-3;

/// η_m(λ) for light from s_g, |s_g| ≤ 1. Linear in wavelength, and in the angle of incidence if the table has several;
/// beyond its ends the table's first or last row or slice holds.
///
/// Never interpolated across a cut-off. An order is cut off after its last non-zero row, if zeros follow: the value of
/// that row holds up to the wavelength λ_c at which the order turns evanescent, d (1 ± s_g)/|m|, or up to the next row
/// if λ_c is not between the two, and is 0 from there. A row at λ_c itself, where solvers print either, does not count.
/// Between a slice that has the order and one that has not, the former's value holds while the order propagates.
/// Since what holds is no mean of rows, the orders' sum may pass 1 there: then all are scaled back to a sum of 1.
double table_efficiency(const EfficiencyTable& table, double pitch_nm, int order, double wavelength_nm, double s_g);

}  // namespace rowland::diffraction
