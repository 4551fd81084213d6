#include "editor/inspector/physics/efficiency_curves.h"

#include <algorithm>
#include <numeric>

#include "engine/colour/sampled_spectrum.h"
#include "modules/diffraction/model/efficiency.h"

namespace rowland::inspector {

std::vector<double> plotted_wavelengths() {
    constexpr int kStep = 4;
    std::vector<double> wavelengths;
    for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; nm += kStep) wavelengths.push_back(nm);
    return wavelengths;
}

std::vector<EfficiencyCurve> efficiency_curves(const diffraction::Grating& grating,
                                               std::span<const double> wavelengths_nm, std::size_t most) {
    std::vector<EfficiencyCurve> curves(1);
    for (const double nm : wavelengths_nm)
        curves[0].efficiency.push_back(diffraction::zero_order_efficiency(grating, nm));
    for (const int order : grating.orders) {
        if (order == 0) continue;
        EfficiencyCurve& curve = curves.emplace_back(EfficiencyCurve{order, {}});
        for (const double nm : wavelengths_nm)
            curve.efficiency.push_back(diffraction::order_efficiency(grating, order, nm));
    }
    const auto power = [](const EfficiencyCurve& curve) {
        return std::accumulate(curve.efficiency.begin(), curve.efficiency.end(), 0.0);
    };
    std::stable_sort(curves.begin() + 1, curves.end(),
                     [&](const EfficiencyCurve& a, const EfficiencyCurve& b) { return power(a) > power(b); });
    if (curves.size() > most) curves.resize(most);
    std::sort(curves.begin(), curves.end(),
              [](const EfficiencyCurve& a, const EfficiencyCurve& b) { return a.order < b.order; });
    return curves;
}

}  // namespace rowland::inspector
