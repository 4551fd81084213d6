#include "engine/colour/light_spectra.h"

#include <array>
#include <glm/geometric.hpp>

#include "engine/colour/observer.h"
#include "engine/colour/spectrum_csv.h"

namespace rowland::colour {

namespace {

std::array<SampledSpectrum, 3> load_basis() {
    const SpectrumTable table = builtin_table("mallett2019_srgb_basis_5nm.csv", "wavelength_nm,r,g,b");
    return {spectrum(table, 0, Outside::Clamp), spectrum(table, 1, Outside::Clamp), spectrum(table, 2, Outside::Clamp)};
}

}  // namespace

glm::dvec3 rgb_basis(double wavelength_nm) {
    static const std::array<SampledSpectrum, 3> basis = load_basis();
    return {basis[0](wavelength_nm), basis[1](wavelength_nm), basis[2](wavelength_nm)};
}

LightSpectra::LightSpectra(Illuminant illuminant)
    : illuminant_(std::move(illuminant)), scale_(1.0 / luminous_power(illuminant_)) {}

glm::dvec3 LightSpectra::operator()(double wavelength_nm) const {
    return scale_ * illuminant_.power(wavelength_nm) * rgb_basis(wavelength_nm);
}

glm::dvec3 rgb_to_xyz(const LightSpectra& spectra, const glm::dvec3& rgb) {
    return integrate_visible<glm::dvec3>(
        [&](double wavelength_nm) { return glm::dot(spectra(wavelength_nm), rgb) * cie_xyz(wavelength_nm); });
}

}  // namespace rowland::colour
