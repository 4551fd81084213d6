#pragma once

#include <glm/mat3x3.hpp>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// R(λ): the metal's reflectance in the medium over it, times what a cover's dye passes twice. 1 for a table of
/// efficiencies, which was measured with both. Of a sheet, the fraction that it transmits; of its reflected side, the
/// rest.
double reflectance(const Grating& grating, double wavelength_nm);

/// The weight of order m at wavelength λ in the diffraction term: R(λ) η_m(λ), for the "agu" normalisation times
/// λ/550 nm (PHYSICS §3). Under a cover η_m and R are those in its medium, and its dye is included; T is not
/// (PHYSICS §10). A table of several incidences is evaluated for light from s_g. Baked representations use the
/// default, normal incidence: light and material separate only if η_m does not depend on s_g.
double order_efficiency(const Grating& grating, int order, double wavelength_nm, double s_g = 0.0);

/// The same at the fractional order d u/λ, from the groove's own spectrum: for fewer than kManyGrooves grooves. A
/// contract violation for tables.
double fractional_order_efficiency(const Grating& grating, double fractional_order, double wavelength_nm);

/// R(λ) η_mk(λ) of a grating with a lattice, in the order of lattice_efficiencies().
std::vector<double> lattice_order_efficiencies(const Grating& grating, double wavelength_nm);

/// R(λ) η_0(λ): the fraction of the power in the mirror reflection or, of a sheet, straight through, whatever the
/// normalisation.
double zero_order_efficiency(const Grating& grating, double wavelength_nm);

/// cmf(λ) E(λ)ᵀ per nm, linear RGB in, XYZ out: what a sum over wavelengths multiplies the efficiency with.
glm::dmat3 observed_spectra(const colour::LightSpectra& spectra, double wavelength_nm);

}  // namespace rowland::diffraction
