#include "modules/diffraction/bake/lattice_terms.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

namespace {

constexpr double kDarkOrder = 1e-9;
constexpr double kFarthest = 2.0;  ///< largest |u| of a pair of directions

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
        if (bright && shortest > 0.0 && shortest <= kFarthest) orders.push_back(std::move(order));
    }
    return orders;
}

std::vector<LatticeOrder> shaded_lattice_orders(const Grating& grating) {
    std::vector<LatticeOrder> orders = lattice_orders(grating);
    if (grating.transmission)
        for (LatticeOrder& order : orders) order.u_per_nm.y = -order.u_per_nm.y;
    return orders;
}

namespace {

/// Up to this number, orders are summed one by one.
constexpr std::size_t kFewOrders = 100;

/// Spacing of the grid on which the pattern's points are merged: an error of 1e-4 in the highest band.
double grid_step_for(int bands) {
    return std::max(0.03 / bands, 0.004);
}

/// Of light that the pattern spreads over `length` along u, the part above the horizon.
struct SeenPart {
    glm::dvec3 s{0.0};      ///< toward its middle
    double fraction = 0.0;  ///< of the whole
};

SeenPart seen_part(const glm::dvec2& u, double length, const glm::dvec2& view) {
    const double distance = glm::length(u);
    const glm::dvec2 along = distance > 0.0 ? u / distance : glm::dvec2(1.0, 0.0);
    // u = 0, the mirror's direction, is above the horizon, so the part ends where |u − v| = 1.
    const double b = glm::dot(along, view);
    const double horizon = b + std::sqrt(std::max(0.0, b * b + 1.0 - glm::dot(view, view)));
    const double fraction = std::clamp((horizon - distance) / length + 0.5, 0.0, 1.0);
    if (fraction == 0.0) return {};
    const glm::dvec2 s_p = (distance - 0.5 * (1.0 - fraction) * length) * along - view;
    return {glm::dvec3(s_p, std::sqrt(std::max(0.0, 1.0 - glm::dot(s_p, s_p)))), fraction};
}

}  // namespace

std::vector<double> lattice_spectrum(const std::vector<LatticeOrder>& orders, const std::optional<Cover>& cover,
                                     const glm::dvec2& view, int bands) {
    const auto count = static_cast<std::size_t>(math::sh_count(bands));
    std::vector<double> result(kWavelengths * count, 0.0);
    std::vector<double> basis(count);
    for (const LatticeOrder& order : orders)
        for (std::size_t j = 0; j < kWavelengths; ++j) {
            const double wavelength_nm = colour::kVisibleMin + static_cast<double>(j);
            const SeenPart part = seen_part(wavelength_nm * order.u_per_nm, glm::length(order.u_per_nm), view);
            if (part.fraction == 0.0) break;
            math::evaluate_sh(part.s, bands, basis);
            const double weight = part.fraction * transmittance(cover, part.s.z) * order.efficiency[j];
            for (std::size_t i = 0; i < count; ++i) result[j * count + i] += weight * basis[i];
        }
    return result;
}

LatticeTerms::LatticeTerms(const Grating& grating, const colour::LightSpectra& spectra, int bands)
    : orders_(shaded_lattice_orders(grating)), cover_(grating.cover), grid_step_(grid_step_for(bands)), bands_(bands) {
    for (std::size_t j = 0; j < kWavelengths; ++j)
        observed_.push_back((j == 0 || j + 1 == kWavelengths ? 0.5 : 1.0) *
                            observed_spectra(spectra, colour::kVisibleMin + static_cast<double>(j)));
    if (orders_.size() <= kFewOrders) return;
    // Each point is divided bilinearly among four nodes of the grid, which keeps each colour's mean direction.
    std::map<std::pair<int, int>, glm::dmat3> grid;
    for (const LatticeOrder& order : orders_)
        for (std::size_t j = 0; j < kWavelengths; ++j) {
            const glm::dvec2 at = (colour::kVisibleMin + static_cast<double>(j)) / grid_step_ * order.u_per_nm;
            if (grid_step_ * glm::length(at) > kFarthest) break;
            const glm::dvec2 low = glm::floor(at);
            const glm::dvec2 t = at - low;
            for (int corner = 0; corner < 4; ++corner) {
                const int x = corner & 1;
                const int y = corner >> 1;
                const double part = (x == 1 ? t.x : 1.0 - t.x) * (y == 1 ? t.y : 1.0 - t.y);
                grid[{static_cast<int>(low.x) + x, static_cast<int>(low.y) + y}] +=
                    part * order.efficiency[j] * observed_[j];
            }
        }
    // A point costs as much as five wavelengths of an order.
    if (5 * grid.size() > orders_.size() * kWavelengths) return;
    for (const auto& [at, weight] : grid) points_.push_back({grid_step_ * glm::dvec2(at.first, at.second), weight});
}

std::vector<glm::dmat3> LatticeTerms::coefficients(const glm::dvec2& view) const {
    std::vector<glm::dmat3> result(static_cast<std::size_t>(math::sh_count(bands_)), glm::dmat3(0.0));
    const auto add = [&](const double* values, const glm::dmat3& weight) {
        for (std::size_t i = 0; i < result.size(); ++i) result[i] += values[i] * weight;
    };
    if (points_.empty()) {
        const std::vector<double> spectrum = lattice_spectrum(orders_, cover_, view, bands_);
        for (std::size_t j = 0; j < kWavelengths; ++j) add(spectrum.data() + j * result.size(), observed_[j]);
        return result;
    }
    std::vector<double> basis(result.size());
    for (const Point& point : points_) {
        const SeenPart part = seen_part(point.u, grid_step_, view);
        if (part.fraction == 0.0) continue;
        math::evaluate_sh(part.s, bands_, basis);
        add(basis.data(), part.fraction * transmittance(cover_, part.s.z) * point.weight);
    }
    return result;
}

namespace {

constexpr int kRange_nm = colour::kVisibleMax - colour::kVisibleMin;

/// Merges one order's wavelengths into nodes.
class OrderNodes {
 public:
    OrderNodes(const glm::dvec2& u_per_nm, double step, std::vector<DiffractionPattern::Node>& nodes)
        : u_per_nm_(u_per_nm), reach_nm_(0.5 * step / glm::length(u_per_nm)), nodes_(nodes) {}
    OrderNodes(const OrderNodes&) = delete;
    OrderNodes& operator=(const OrderNodes&) = delete;
    ~OrderNodes() { finish(); }

    void add(double wavelength_nm, const glm::dmat3& weight) {
        if (power_ > 0.0 && wavelength_nm - begin_nm_ > reach_nm_) finish();
        if (power_ == 0.0) begin_nm_ = wavelength_nm;
        double power = 1e-300;
        for (int c = 0; c < 3; ++c) power += weight[c].x + weight[c].y + weight[c].z;
        power_ += power;
        moment_ += power * wavelength_nm;
        weight_ += weight;
    }

 private:
    void finish() {
        if (power_ == 0.0) return;
        const double mean_nm = moment_ / power_;
        nodes_.push_back({glm::vec2(mean_nm * u_per_nm_), static_cast<float>(mean_nm), glm::mat3(weight_)});
        power_ = moment_ = 0.0;
        weight_ = glm::dmat3(0.0);
    }

    glm::dvec2 u_per_nm_;
    double reach_nm_;
    std::vector<DiffractionPattern::Node>& nodes_;
    double begin_nm_ = 0.0;
    double power_ = 0.0;
    double moment_ = 0.0;
    glm::dmat3 weight_{0.0};
};

}  // namespace

std::vector<DiffractionPattern::Node> lattice_nodes(const Grating& grating, const colour::LightSpectra& spectra,
                                                    double step) {
    std::vector<DiffractionPattern::Node> nodes;
    for (const LatticeOrder& order : lattice_orders(grating)) {
        const double u_of_1nm = glm::length(order.u_per_nm);
        const int nodes_per_nm = std::max(1, static_cast<int>(std::ceil(u_of_1nm / step)));
        const int last = kRange_nm * nodes_per_nm;
        OrderNodes joined(order.u_per_nm, step, nodes);
        for (int i = 0; i <= last; ++i) {
            const double beyond_nm = static_cast<double>(i) / nodes_per_nm;
            const double wavelength_nm = colour::kVisibleMin + beyond_nm;
            if (u_of_1nm * wavelength_nm > kFarthest) break;
            const auto below = static_cast<std::size_t>(std::min(static_cast<int>(beyond_nm), kRange_nm - 1));
            const double efficiency =
                std::lerp(order.efficiency[below], order.efficiency[below + 1], beyond_nm - static_cast<double>(below));
            const double step_nm = (i == 0 || i == last ? 0.5 : 1.0) / nodes_per_nm;
            joined.add(wavelength_nm, step_nm * efficiency * observed_spectra(spectra, wavelength_nm));
        }
    }
    return nodes;
}

}  // namespace rowland::diffraction
