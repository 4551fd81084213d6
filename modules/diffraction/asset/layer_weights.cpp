#include "modules/diffraction/asset/layer_weights.h"

#include <algorithm>
#include <numeric>

#include "engine/colour/light_spectra.h"
#include "engine/colour/observer.h"
#include "modules/diffraction/model/efficiency.h"

namespace rowland::diffraction {

namespace {

/// Of one wavelength.
struct Efficiencies {
    double zero = 0.0;    ///< η₀
    double listed = 0.0;  ///< Σ listed η without η₀
};

Efficiencies efficiencies(const Grating& grating, double wavelength_nm) {
    if (grating.lattice) {
        const std::vector<double> orders = lattice_order_efficiencies(grating, wavelength_nm);
        const double zero = orders[orders.size() / 2];
        return {zero, std::accumulate(orders.begin(), orders.end(), -zero)};
    }
    Efficiencies found{.zero = zero_order_efficiency(grating, wavelength_nm)};
    for (const int order : grating.orders)
        if (order != 0) found.listed += order_efficiency(grating, order, wavelength_nm);
    return found;
}

}  // namespace

LayerWeights layer_weights(const Grating& grating, const colour::Illuminant& illuminant) {
    const std::optional<Grating> other_side = reflected_side(grating);
    const colour::LightSpectra spectra(illuminant);
    const bool lists_zero = std::find(grating.orders.begin(), grating.orders.end(), 0) != grating.orders.end();
    LayerWeights weights{.mirror = glm::dvec3(0.0), .base = glm::dvec3(0.0)};
    for (int wavelength_nm = colour::kVisibleMin; wavelength_nm <= colour::kVisibleMax; ++wavelength_nm) {
        const bool end = wavelength_nm == colour::kVisibleMin || wavelength_nm == colour::kVisibleMax;
        const glm::dvec3 e = spectra(wavelength_nm);
        const glm::dvec3 white = (end ? 0.5 : 1.0) * (e.r + e.g + e.b) * colour::cie_xyz(wavelength_nm);
        const Efficiencies of_grating = efficiencies(grating, wavelength_nm);
        const Efficiencies of_other = other_side ? efficiencies(*other_side, wavelength_nm) : Efficiencies{};
        const double taken = of_grating.zero + of_grating.listed + (of_other.zero + of_other.listed);
        if (!lists_zero) weights.mirror += of_grating.zero * white;
        if (!grating.side_reflectance) weights.base += std::max(0.0, 1.0 - taken) * white;
    }
    return weights;
}

}  // namespace rowland::diffraction
