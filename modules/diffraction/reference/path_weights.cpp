#include "modules/diffraction/reference/path_weights.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/model/efficiency.h"
#include "modules/diffraction/model/fejer.h"
#include "modules/diffraction/model/grating_equation.h"

namespace rowland::diffraction {

namespace {

/// cmf Eᵀ dλ at one node of the trapezoid rule over the visible range.
struct ObservedNode {
    double wavelength_nm = 0.0;
    glm::dmat3 observed{0.0};
};

std::vector<ObservedNode> observed_nodes(const colour::LightSpectra& spectra, int nodes_per_nm) {
    const int last = (colour::kVisibleMax - colour::kVisibleMin) * nodes_per_nm;
    std::vector<ObservedNode> nodes;
    for (int i = 0; i <= last; ++i) {
        const double wavelength_nm = colour::kVisibleMin + static_cast<double>(i) / nodes_per_nm;
        const double step_nm = (i == 0 || i == last ? 0.5 : 1.0) / nodes_per_nm;
        nodes.push_back({wavelength_nm, step_nm * observed_spectra(spectra, wavelength_nm)});
    }
    return nodes;
}

/// Sharp orders: the light of order m and wavelength λ lies on one arc.
std::vector<PathWeight> sharp_orders(const Grating& grating, const colour::LightSpectra& spectra, double largest_step,
                                     int refinement) {
    std::vector<PathWeight> weights;
    const bool at_each_arc = depends_on_incidence(grating.profile);
    for (const int order : grating.orders) {
        const double step_at_1nm = std::abs(order) / grating.pitch_nm;
        const int nodes_per_nm = refinement * std::max(1, static_cast<int>(std::ceil(step_at_1nm / largest_step)));
        for (const auto& [wavelength_nm, observed] : observed_nodes(spectra, nodes_per_nm)) {
            const double efficiency = at_each_arc ? 1.0 : order_efficiency(grating, order, wavelength_nm);
            weights.push_back({order * wavelength_nm, wavelength_nm, efficiency * observed, order});
        }
    }
    return weights;
}

/// The weight at one path difference of few grooves: every wavelength contributes, by its Fejér ratio.
glm::dmat3 blurred_weight(const Grating& grating, const std::vector<ObservedNode>& spectrum, double path_nm) {
    glm::dmat3 sum(0.0);
    for (const ObservedNode& node : spectrum) {
        const double fractional_order = path_nm / node.wavelength_nm;
        const double nearest = std::round(fractional_order);
        const int order = static_cast<int>(nearest);
        if (!lists(grating, order) || !propagates(order, node.wavelength_nm, grating.pitch_nm)) continue;
        const double density = grating.grooves / node.wavelength_nm *
                               fejer(grating.grooves, fractional_order - nearest) *
                               fractional_order_efficiency(grating, fractional_order, node.wavelength_nm);
        sum += density * node.observed;
    }
    return sum;
}

/// Wide orders. The lobe is evaluated at the middle of the range: those allowed with few grooves do not depend on
/// wavelength.
std::vector<PathWeight> wide_orders(const Grating& grating, const colour::LightSpectra& spectra, double largest_step,
                                    int refinement) {
    const std::vector<ObservedNode> spectrum = observed_nodes(spectra, refinement);
    ROWLAND_CHECK(!std::holds_alternative<PitsLobe>(grating.lobe), "pits with few grooves");
    // An order is λ/N ≥ 7.7 nm wide in x.
    const double step_nm = std::min(1.0, largest_step * grating.pitch_nm) / refinement;
    const double largest_path_nm = 2.0 * grating.pitch_nm;
    const auto half_count = static_cast<std::size_t>(std::ceil(largest_path_nm / step_nm));
    std::vector<PathWeight> weights(2 * half_count + 1);
    parallel_for(weights.size(), [&](std::size_t i) {
        const double path_nm = step_nm * (static_cast<double>(i) - static_cast<double>(half_count));
        weights[i] = {path_nm, 0.5 * (colour::kVisibleMin + colour::kVisibleMax),
                      step_nm * blurred_weight(grating, spectrum, path_nm)};
    });
    return weights;
}

}  // namespace

std::vector<PathWeight> path_weights(const Grating& grating, const colour::LightSpectra& spectra, double largest_step,
                                     int refinement) {
    ROWLAND_CHECK_OP(grating.pitch_nm, >, 0.0);
    ROWLAND_CHECK_OP(grating.grooves, >=, 1.0);
    ROWLAND_CHECK_OP(largest_step, >, 0.0);
    ROWLAND_CHECK_OP(refinement, >=, 1);
    auto weights = grating.grooves >= kManyGrooves ? sharp_orders(grating, spectra, largest_step, refinement)
                                                   : wide_orders(grating, spectra, largest_step, refinement);
    std::erase_if(weights, [](const PathWeight& term) { return term.weight == glm::dmat3(0.0); });
    return weights;
}

}  // namespace rowland::diffraction
