#include "modules/diffraction/model/efficiency.h"

#include <glm/matrix.hpp>

#include "engine/colour/observer.h"
#include "engine/core/check.h"

namespace rowland::diffraction {

namespace {

/// The wavelength in the medium that the grooves lie in, which sets the phase of a groove's depth. A table's is in air.
double groove_wavelength(const Grating& grating, double wavelength_nm) {
    if (std::holds_alternative<EfficiencyTable>(grating.profile)) return wavelength_nm;
    return wavelength_nm / groove_medium(grating.cover);
}

/// The ratio of the paper's peak form to the energy form, 2λ/(N d (b/d)²)·I₀, where I₀ makes it 1 at 550 nm.
double normalization_factor(const Grating& grating, double wavelength_nm) {
    if (grating.normalization == Normalization::Energy) return 1.0;
    ROWLAND_CHECK(std::holds_alternative<SlitProfile>(grating.profile), "the agu normalisation is for slits");
    return wavelength_nm / kAguWavelength_nm;
}

}  // namespace

double reflectance(const Grating& grating, double wavelength_nm) {
    if (std::holds_alternative<EfficiencyTable>(grating.profile)) return 1.0;
    const double metal =
        grating.metal ? colour::metal_reflectance(*grating.metal, wavelength_nm, groove_medium(grating.cover)) : 1.0;
    return metal * dye_transmittance(grating.cover, wavelength_nm);
}

double order_efficiency(const Grating& grating, int order, double wavelength_nm, double s_g) {
    return reflectance(grating, wavelength_nm) * normalization_factor(grating, wavelength_nm) *
           profile_efficiency(grating.profile, grating.pitch_nm, order, groove_wavelength(grating, wavelength_nm), s_g);
}

double fractional_order_efficiency(const Grating& grating, double fractional_order, double wavelength_nm) {
    return reflectance(grating, wavelength_nm) * normalization_factor(grating, wavelength_nm) *
           groove_spectrum(grating.profile, grating.pitch_nm, fractional_order,
                           groove_wavelength(grating, wavelength_nm));
}

double zero_order_efficiency(const Grating& grating, double wavelength_nm) {
    return reflectance(grating, wavelength_nm) *
           profile_efficiency(grating.profile, grating.pitch_nm, 0, groove_wavelength(grating, wavelength_nm));
}

glm::dmat3 observed_spectra(const colour::LightSpectra& spectra, double wavelength_nm) {
    return glm::outerProduct(colour::cie_xyz(wavelength_nm), spectra(wavelength_nm));
}

}  // namespace rowland::diffraction
