#pragma once

#include <memory>
#include <string>

#include "modules/diffraction/model/efficiency_grid.h"
#include "modules/diffraction/rigorous/relief.h"

namespace rowland::diffraction {

/// A tenth of what interpolation between the grid's nodes may be off; silver's edges under a cover leave no less.
inline constexpr double kGridTolerance = 2e-3;

struct SolvedEfficiencies {
    EfficiencyGrid grid;
    double error = 0.0;  ///< the largest change of an efficiency by the last orders that were added
    int solves = 0;
};

/// The efficiencies of all orders that leave a substrate with a relief, for light of all visible wavelengths from all
/// directions of the classical plane, each mean of both polarisations. The relief may be on either side of a sheet: the
/// mean of both. Converged to kGridTolerance. Uses all cores, the result does not depend on their number; shows
/// progress as `name`. Throws Error (input) as solve_converged().
///
/// One solve gives light from directions λ/d apart: a wavelength takes as many as fill the grid's step, of a symmetric
/// relief half of them.
SolvedEfficiencies solve_efficiencies(const Relief& relief, const Substrate& substrate, const std::string& name);

/// The grid of a grating that relief_of() takes. Those of the last few reliefs are kept. Of a sheet of reflectance ρ
/// all are reduced by one factor where they and ρ would exceed 1.
std::shared_ptr<const EfficiencyGrid> rigorous_efficiencies(const Grating& grating, const std::string& name);

}  // namespace rowland::diffraction
