#pragma once

#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// The weight of order m at wavelength λ in the diffraction term: R(λ) η_m(λ), and for the "agu" normalisation times
/// λ/550 nm. What every representation multiplies with. Where η_m depends on the incidence (a table of several), it is
/// that of light from s_g; at the default, normal incidence, the weight is what light and material separate with.
double order_efficiency(const Grating& grating, int order, double wavelength_nm, double s_g = 0.0);

/// The same at a fractional order x = d u/λ, from the groove's own spectrum: for fewer than kManyGrooves grooves. Not
/// for tables.
double fractional_order_efficiency(const Grating& grating, double fractional_order, double wavelength_nm);

/// R(λ) η_0(λ): the share of the power that a mirror reflection carries, whatever the normalisation.
double zero_order_efficiency(const Grating& grating, double wavelength_nm);

}  // namespace rowland::diffraction
