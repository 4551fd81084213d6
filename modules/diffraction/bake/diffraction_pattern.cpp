#include "modules/diffraction/bake/diffraction_pattern.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/check.h"
#include "modules/diffraction/bake/lattice_nodes.h"
#include "modules/diffraction/model/efficiency.h"

namespace rowland::diffraction {

namespace {

/// Relative difference of efficiencies that counts as none.
constexpr double kSameEfficiency = 1e-6;
/// Every so many nanometres efficiencies are compared.
constexpr int kCompared_nm = 5;

bool as_bright(const Grating& grating, int a, int b) {
    for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; nm += kCompared_nm) {
        const double first = order_efficiency(grating, a, nm);
        if (std::abs(first - order_efficiency(grating, b, nm)) > kSameEfficiency * std::abs(first)) return false;
    }
    return true;
}

bool is_even_lattice(const Grating& grating) {
    constexpr double kDark = 1e-12;
    for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; nm += kCompared_nm) {
        const std::vector<double> orders = lattice_order_efficiencies(grating, nm);
        for (std::size_t i = 0; i < orders.size() / 2; ++i)
            if (std::abs(orders[i] - orders[orders.size() - 1 - i]) > kSameEfficiency * orders[i] + kDark) return false;
    }
    return true;
}

void add_order(const Grating& grating, const colour::LightSpectra& spectra, int order, double step,
               std::vector<DiffractionPattern::Node>& nodes) {
    constexpr double kFarthest = 2.0;
    const double u_per_nm = order / grating.pitch_nm;
    const int nodes_per_nm = std::max(1, static_cast<int>(std::ceil(std::abs(u_per_nm) / step)));
    const int last = (colour::kVisibleMax - colour::kVisibleMin) * nodes_per_nm;
    for (int i = 0; i <= last; ++i) {
        const double wavelength_nm = colour::kVisibleMin + static_cast<double>(i) / nodes_per_nm;
        const double u = u_per_nm * wavelength_nm;
        if (std::abs(u) > kFarthest) break;
        const double step_nm = (i == 0 || i == last ? 0.5 : 1.0) / nodes_per_nm;
        const glm::dmat3 weight =
            step_nm * order_efficiency(grating, order, wavelength_nm) * observed_spectra(spectra, wavelength_nm);
        nodes.push_back({glm::vec2(u, 0.0), static_cast<float>(wavelength_nm), glm::mat3(weight)});
    }
}

}  // namespace

bool is_even(const Grating& grating) {
    if (grating.lattice) return is_even_lattice(grating);
    return std::all_of(grating.orders.begin(), grating.orders.end(),
                       [&](int order) { return lists(grating, -order) && as_bright(grating, order, -order); });
}

DiffractionPattern diffraction_pattern(const Grating& grating, const colour::LightSpectra& spectra, double step) {
    ROWLAND_CHECK_OP(grating.pitch_nm, >, 0.0);
    if (grating.lattice)
        return {.nodes = lattice_nodes(grating, spectra, step),
                .lobe = std::nullopt,
                .even = is_even(grating),
                .cover = grating.cover};
    DiffractionPattern pattern{.nodes = {}, .lobe = grating.lobe, .even = is_even(grating), .cover = grating.cover};
    for (const int order : grating.orders) add_order(grating, spectra, order, step, pattern.nodes);
    return pattern;
}

DiffractionPattern shaded_pattern(const Grating& grating, const colour::LightSpectra& spectra, double step) {
    DiffractionPattern pattern = diffraction_pattern(grating, spectra, step);
    if (grating.transmission)
        for (DiffractionPattern::Node& node : pattern.nodes) node.u.y = -node.u.y;
    return pattern;
}

DiffractionPattern in_space(DiffractionPattern pattern, const glm::dmat3& xyz_to_space) {
    for (DiffractionPattern::Node& node : pattern.nodes)
        node.weight = glm::mat3(xyz_to_space * glm::dmat3(node.weight));
    return pattern;
}

}  // namespace rowland::diffraction
