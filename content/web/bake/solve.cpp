// Rigorous theory: the efficiencies of grooves, by Maxwell's equations.
#include <array>
#include <variant>

#include "content/web/bake/exports.h"
#include "modules/diffraction/rigorous/efficiencies.h"
#include "modules/diffraction/rigorous/relief.h"

namespace rowland::web {

/// Efficiencies as read_material() of material.cpp takes them. The arguments are its facts about the relief. Takes
/// seconds; those of the last few reliefs are kept.
ROWLAND_EXPORT(solve)
Numbers* solve(unsigned shape, double pitch_nm, double depth_nm, double duty, double ior, int metal,
               double reflectance) {
    using namespace diffraction;
    Grating grating{.pitch_nm = pitch_nm};
    if (metal < 0) {
        grating.transmission = Transmission{.ior = ior, .reflectance = reflectance};
    } else {
        grating.metal = static_cast<colour::Metal>(metal);
        grating.cover = Cover{.ior = ior};
    }
    const std::array<ReliefShape, 3> shapes = {LamellarProfile{.duty = duty, .depth_nm = depth_nm},
                                               SinusoidalProfile{.depth_nm = depth_nm},
                                               BlazedProfile{.depth_nm = depth_nm}};
    static_assert(shapes.size() == std::variant_size_v<ReliefShape>);
    for (const ReliefShape& known : shapes)
        if (known.index() + 1 == shape) std::visit([&](const auto& profile) { grating.profile = profile; }, known);
    const std::shared_ptr<const EfficiencyGrid> grid = rigorous_efficiencies(grating, "material");
    auto* numbers = new Numbers{static_cast<float>(EfficiencyGrid::wavelength_at(0)), EfficiencyGrid::kStep_nm,
                                EfficiencyGrid::kViews, static_cast<float>(grid->orders.size())};
    for (const int order : grid->orders) append(static_cast<float>(order), *numbers);
    numbers->insert(numbers->end(), grid->values.begin(), grid->values.end());
    return numbers;
}

}  // namespace rowland::web
