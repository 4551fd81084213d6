#include "modules/diffraction/bake/lattice_nodes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "modules/diffraction/bake/lattice_orders.h"
#include "modules/diffraction/model/efficiency.h"

namespace rowland::diffraction {

namespace {

constexpr int kRange_nm = colour::kVisibleMax - colour::kVisibleMin;
constexpr double kFarthest = 2.0;

/// One order's wavelengths, joined to nodes.
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
