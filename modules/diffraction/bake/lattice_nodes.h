#pragma once

#include <vector>

#include "modules/diffraction/bake/diffraction_pattern.h"

namespace rowland::diffraction {

/// The diffraction pattern of a grating with a lattice as points, PHYSICS (46). An order's points are at most `step`
/// apart in u; each holds all light of the wavelengths around it. Orders darker than 1e-9 are left out.
std::vector<DiffractionPattern::Node> lattice_nodes(const Grating& grating, const colour::LightSpectra& spectra,
                                                    double step);

}  // namespace rowland::diffraction
