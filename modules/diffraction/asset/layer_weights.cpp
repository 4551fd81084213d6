#include "modules/diffraction/asset/layer_weights.h"

#include <algorithm>

#include "engine/colour/light_spectra.h"
#include "engine/colour/observer.h"
#include "modules/diffraction/model/efficiency.h"

namespace rowland::diffraction {

LayerWeights layer_weights(const Grating& grating, const colour::Illuminant& illuminant) {
    const colour::LightSpectra spectra(illuminant);
    const bool lists_zero = std::find(grating.orders.begin(), grating.orders.end(), 0) != grating.orders.end();
    LayerWeights weights{.mirror = glm::dvec3(0.0), .base = glm::dvec3(0.0)};
    for (int wavelength_nm = colour::kVisibleMin; wavelength_nm <= colour::kVisibleMax; ++wavelength_nm) {
        const bool end = wavelength_nm == colour::kVisibleMin || wavelength_nm == colour::kVisibleMax;
        const glm::dvec3 e = spectra(wavelength_nm);
        const glm::dvec3 white = (end ? 0.5 : 1.0) * (e.r + e.g + e.b) * colour::cie_xyz(wavelength_nm);
        const double zero = zero_order_efficiency(grating, wavelength_nm);
        double listed = 0.0;
        for (const int order : grating.orders)
            if (order != 0) listed += order_efficiency(grating, order, wavelength_nm);
        if (!lists_zero) weights.mirror += zero * white;
        weights.base += std::max(0.0, 1.0 - listed - zero) * white;
    }
    return weights;
}

}  // namespace rowland::diffraction
