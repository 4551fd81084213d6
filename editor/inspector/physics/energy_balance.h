#pragma once

#include "modules/diffraction/model/grating.h"

namespace rowland::inspector {

/// Where the power of one wavelength goes, as shares that sum to 1.
struct EnergyBalance {
    double orders = 0.0;      ///< listed orders that leave the surface
    double zero = 0.0;        ///< the mirror's order
    double evanescent = 0.0;  ///< given to listed orders that do not leave it: lost to the scalar model
    double absorbed = 0.0;    ///< by the metal, or what a table's orders leave of 1
    double rest = 0.0;        ///< orders that are not listed, and what the groove's shape loses: lights the base
};

/// For light of a wavelength from s_g, |s_g| ≤ 1, energy-normalised whatever the material asks for.
EnergyBalance energy_balance(diffraction::Grating grating, double wavelength_nm, double s_g);

}  // namespace rowland::inspector
