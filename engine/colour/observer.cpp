#include "engine/colour/observer.h"

#include <array>

#include "engine/colour/spectrum_csv.h"

namespace rowland::colour {

namespace {

std::array<SampledSpectrum, 3> load_observer() {
    const SpectrumTable table = builtin_table("cie1931_2deg_xyz_1nm.csv", "wavelength_nm,xbar,ybar,zbar");
    return {spectrum(table, 0, Outside::Zero), spectrum(table, 1, Outside::Zero), spectrum(table, 2, Outside::Zero)};
}

}  // namespace

glm::dvec3 cie_xyz(double wavelength_nm) {
    static const std::array<SampledSpectrum, 3> observer = load_observer();
    return {observer[0](wavelength_nm), observer[1](wavelength_nm), observer[2](wavelength_nm)};
}

}  // namespace rowland::colour
