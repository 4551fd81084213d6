#pragma once

#include <memory>
#include <string>

#include "modules/diffraction/model/efficiency_grid.h"
#include "modules/diffraction/rigorous/relief.h"

namespace rowland::diffraction {

/// Tolerance to which efficiencies converge: a tenth of the error that interpolation between the grid's nodes may have.
/// Silver reliefs with edges, under a cover, converge no further.
inline constexpr double kGridTolerance = 2e-3;

struct SolvedEfficiencies {
    EfficiencyGrid grid;
    double error = 0.0;  ///< largest change of an efficiency in the last increase of a truncation
    int solves = 0;      ///< number of calls of solve() once the truncations are chosen
};

/// The efficiencies of all orders that leave a substrate with a relief, for light of all visible wavelengths from all
/// directions of the classical plane; means of both polarisations and, for a sheet, of the relief on either side.
/// Converged to kGridTolerance. Uses all cores; the result does not depend on their number. Shows progress as `name`.
/// Throws Error (input) as check_relief() and solve_converged() do.
///
/// One solve gives light from directions λ/d apart. Each wavelength takes as many solves as make the directions as
/// dense as the grid's; a symmetric relief takes half of them.
SolvedEfficiencies solve_efficiencies(const Relief& relief, const Substrate& substrate, const std::string& name);

/// solve_efficiencies() of a grating. The grids of the last few reliefs are kept. If for some direction the
/// efficiencies of a sheet and its reflectance sum to more than 1, all its efficiencies are reduced by one factor.
/// Throws Error (input) as relief_of() and solve_efficiencies() do.
std::shared_ptr<const EfficiencyGrid> rigorous_efficiencies(const Grating& grating, const std::string& name);

}  // namespace rowland::diffraction
