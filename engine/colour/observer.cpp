#include "engine/colour/observer.h"

#include <array>
#include <string>

#include "engine/colour/embedded_tables.h"
#include "engine/colour/spectrum_csv.h"

namespace rowland::colour {

namespace {

std::array<SampledSpectrum, 3> load_observer() {
    const SpectrumTable table =
        parse_spectrum_csv(embedded::kCie1931, "cie1931_2deg_xyz_1nm.csv", "wavelength_nm,xbar,ybar,zbar");
    const auto column = [&](std::size_t i) {
        return SampledSpectrum(table.wavelengths_nm, table.columns[i], Outside::Zero);
    };
    return {column(0), column(1), column(2)};
}

}  // namespace

glm::dvec3 cie_xyz(double wavelength_nm) {
    static const std::array<SampledSpectrum, 3> observer = load_observer();
    return {observer[0](wavelength_nm), observer[1](wavelength_nm), observer[2](wavelength_nm)};
}

}  // namespace rowland::colour
