#include "modules/diffraction/bake/lattice_orders.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <utility>

#include "engine/core/parallel.h"
#include "modules/diffraction/model/efficiency.h"

namespace rowland::diffraction {

namespace {

constexpr double kDarkOrder = 1e-9;
constexpr double kFarthestOrder = 2.0;  ///< |u| of all pairs of directions

}  // namespace

std::vector<LatticeOrder> lattice_orders(const Grating& grating) {
    const Lattice& lattice = *grating.lattice;
    std::vector<std::vector<double>> by_wavelength(colour::kVisibleMax - colour::kVisibleMin + 1);
    parallel_for(by_wavelength.size(), [&](std::size_t j) {
        by_wavelength[j] = lattice_order_efficiencies(grating, colour::kVisibleMin + static_cast<double>(j));
    });
    const glm::dmat2 stars = reciprocal(lattice);
    const int columns = order_columns(lattice);
    std::vector<LatticeOrder> orders;
    for (std::size_t i = 0; i < by_wavelength[0].size(); ++i) {
        LatticeOrder order;
        order.u_per_nm = stars * glm::dvec2(static_cast<int>(i) % columns - lattice.orders,
                                            static_cast<int>(i) / columns - lattice.orders);
        for (const std::vector<double>& efficiencies : by_wavelength) order.efficiency.push_back(efficiencies[i]);
        const bool bright = *std::max_element(order.efficiency.begin(), order.efficiency.end()) >= kDarkOrder;
        const double shortest = colour::kVisibleMin * glm::length(order.u_per_nm);
        if (bright && shortest > 0.0 && shortest <= kFarthestOrder) orders.push_back(std::move(order));
    }
    return orders;
}

std::vector<LatticeOrder> shaded_lattice_orders(const Grating& grating) {
    std::vector<LatticeOrder> orders = lattice_orders(grating);
    if (grating.transmission)
        for (LatticeOrder& order : orders) order.u_per_nm.y = -order.u_per_nm.y;
    return orders;
}

}  // namespace rowland::diffraction
