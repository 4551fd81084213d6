#include "editor/inspector/physics/energy_balance.h"

#include <algorithm>

#include "engine/colour/metal.h"
#include "modules/diffraction/model/efficiency.h"
#include "modules/diffraction/model/grating_equation.h"

namespace rowland::inspector {

namespace {

double absorbed_share(const diffraction::Grating& grating, double wavelength_nm, double s_g) {
    if (const auto* table = std::get_if<diffraction::EfficiencyTable>(&grating.profile)) {
        double reflected = 0.0;
        for (const int order : table->orders)
            reflected += diffraction::profile_efficiency(grating.profile, grating.pitch_nm, order, wavelength_nm, s_g);
        return std::max(0.0, 1.0 - reflected);
    }
    return grating.metal ? 1.0 - colour::metal_reflectance(*grating.metal, wavelength_nm) : 0.0;
}

}  // namespace

EnergyBalance energy_balance(diffraction::Grating grating, double wavelength_nm, double s_g) {
    grating.normalization = diffraction::Normalization::Energy;
    EnergyBalance balance{.zero = diffraction::zero_order_efficiency(grating, wavelength_nm),
                          .absorbed = absorbed_share(grating, wavelength_nm, s_g)};
    for (const int order : grating.orders) {
        if (order == 0) continue;
        const double share = diffraction::order_efficiency(grating, order, wavelength_nm, s_g);
        const bool leaves = diffraction::diffracted_cosine(s_g, order, wavelength_nm, grating.pitch_nm).has_value();
        (leaves ? balance.orders : balance.evanescent) += share;
    }
    balance.rest = std::max(0.0, 1.0 - balance.orders - balance.zero - balance.evanescent - balance.absorbed);
    return balance;
}

}  // namespace rowland::inspector
