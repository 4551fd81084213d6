// Rigorous theory: the efficiencies of grooves, by Maxwell's equations.
#include "content/web/bake/exports.h"
#include "modules/diffraction/rigorous/efficiencies.h"

namespace rowland::web {

/// Efficiencies as read_material() of material.cpp takes them. The arguments are its facts about the relief. Takes
/// seconds; those of the last few reliefs are kept.
ROWLAND_EXPORT(solve)
Numbers* solve(int profile, double pitch_nm, double depth_nm, double duty, double ior, int metal, double reflectance) {
    using namespace diffraction;
    Grating grating{.pitch_nm = pitch_nm};
    if (metal < 0) {
        grating.transmission = Transmission{.ior = ior, .reflectance = reflectance};
    } else {
        grating.metal = static_cast<colour::Metal>(metal);
        grating.cover = Cover{.ior = ior};
    }
    switch (profile) {
        case 1:
            grating.profile = LamellarProfile{.duty = duty, .depth_nm = depth_nm};
            break;
        case 2:
            grating.profile = SinusoidalProfile{.depth_nm = depth_nm};
            break;
        case 3:
            grating.profile = BlazedProfile{.depth_nm = depth_nm};
            break;
    }
    const std::shared_ptr<const EfficiencyGrid> grid = rigorous_efficiencies(grating, "material");
    auto* numbers = new Numbers{static_cast<float>(EfficiencyGrid::wavelength_at(0)), EfficiencyGrid::kStep_nm,
                                EfficiencyGrid::kViews, static_cast<float>(grid->orders.size())};
    for (const int order : grid->orders) append(static_cast<float>(order), *numbers);
    numbers->insert(numbers->end(), grid->values.begin(), grid->values.end());
    return numbers;
}

}  // namespace rowland::web
