#pragma once

#include <span>
#include <vector>

#include "modules/diffraction/model/grating.h"

namespace rowland::inspector {

/// The share of the power that one order gets, over wavelength.
struct EfficiencyCurve {
    int order = 0;
    std::vector<double> efficiency;  ///< one a wavelength
};

/// 380 to 780 nm.
std::vector<double> plotted_wavelengths();

/// The mirror's and the listed orders' efficiencies at normal incidence; of many orders the `most` strongest.
/// Ascending.
std::vector<EfficiencyCurve> efficiency_curves(const diffraction::Grating& grating,
                                               std::span<const double> wavelengths_nm, std::size_t most = 9);

}  // namespace rowland::inspector
