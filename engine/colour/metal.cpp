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

std::optional<Metal> parse_metal(const std::string& name) {
    for (std::size_t i = 0; i < kNames.size(); ++i)
        if (name == kNames[i]) return static_cast<Metal>(i);
    return std::nullopt;
}

std::string metal_name(Metal metal) {
    return std::string(kNames[static_cast<std::size_t>(metal)]);
}

double metal_reflectance(Metal metal, double wavelength_nm, double medium) {
    static const std::array<RefractiveIndex, 4> indices = {load_index(Metal::Al), load_index(Metal::Ag),
                                                           load_index(Metal::Au), load_index(Metal::Cu)};
    const RefractiveIndex& index = indices[static_cast<std::size_t>(metal)];
    const double n = index.n(wavelength_nm);
    const double k = index.k(wavelength_nm);
    return ((n - medium) * (n - medium) + k * k) / ((n + medium) * (n + medium) + k * k);
}

}  // namespace rowland::colour
