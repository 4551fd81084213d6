#include "engine/colour/metal.h"

#include <array>
#include <string_view>

#include "engine/colour/sampled_spectrum.h"
#include "engine/colour/spectrum_csv.h"

namespace rowland::colour {

namespace {

constexpr std::array<std::string_view, 4> kNames = {"Al", "Ag", "Au", "Cu"};

struct RefractiveIndex {
    SampledSpectrum n;
    SampledSpectrum k;
};

RefractiveIndex load_index(Metal metal) {
    const SpectrumTable table = builtin_table("metals/" + metal_name(metal) + "_nk.csv", "wavelength_nm,n,k");
    return {spectrum(table, 0, Outside::Clamp), spectrum(table, 1, Outside::Clamp)};
}

}  // namespace

std::vector<std::string> metal_names() {
    return {kNames.begin(), kNames.end()};
}

std::optional<Metal> parse_metal(const std::string& name) {
    for (std::size_t i = 0; i < kNames.size(); ++i)
        if (name == kNames[i]) return static_cast<Metal>(i);
    return std::nullopt;
}

std::string metal_name(Metal metal) {
    return std::string(kNames[static_cast<std::size_t>(metal)]);
}

std::complex<double> metal_index(Metal metal, double wavelength_nm) {
    static const std::array<RefractiveIndex, 4> indices = {load_index(Metal::Al), load_index(Metal::Ag),
                                                           load_index(Metal::Au), load_index(Metal::Cu)};
    const RefractiveIndex& index = indices[static_cast<std::size_t>(metal)];
    return {index.n(wavelength_nm), index.k(wavelength_nm)};
}

double metal_reflectance(Metal metal, double wavelength_nm, double medium) {
    const std::complex<double> index = metal_index(metal, wavelength_nm);
    const double n = index.real();
    const double k = index.imag();
    return ((n - medium) * (n - medium) + k * k) / ((n + medium) * (n + medium) + k * k);
}

}  // namespace rowland::colour
