#include "engine/colour/light_spectra.h"

#include <array>
#include <glm/geometric.hpp>

#include "engine/colour/embedded_tables.h"
#include "engine/colour/observer.h"
#include "engine/colour/spectrum_csv.h"

namespace rowland::colour {

namespace {

std::array<SampledSpectrum, 3> load_basis() {
    const SpectrumTable table =
        parse_spectrum_csv(embedded::kMallett2019, "mallett2019_srgb_basis_5nm.csv", "wavelength_nm,r,g,b");
    const auto column = [&](std::size_t i) {
        return SampledSpectrum(table.wavelengths_nm, table.columns[i], Outside::Clamp);
    };
    return {column(0), column(1), column(2)};
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
    glm::dvec3 sum(0.0);
    for (int wavelength_nm = kVisibleMin; wavelength_nm <= kVisibleMax; ++wavelength_nm) {
        const double weight = wavelength_nm == kVisibleMin || wavelength_nm == kVisibleMax ? 0.5 : 1.0;
        sum += weight * glm::dot(spectra(wavelength_nm), rgb) * cie_xyz(wavelength_nm);
    }
    return sum;
}

}  // namespace rowland::colour
