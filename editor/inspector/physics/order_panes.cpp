#include "editor/inspector/physics/order_panes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/colour/sampled_spectrum.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/efficiency.h"
#include "modules/diffraction/model/grating_equation.h"

namespace rowland::inspector {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

glm::dvec3 direction(double angle_deg) {
    return {std::sin(angle_deg * kDegree), 0.0, std::cos(angle_deg * kDegree)};
}

std::vector<int> shown_orders(const diffraction::Grating& grating) {
    std::vector<int> orders = grating.orders;
    if (std::find(orders.begin(), orders.end(), 0) == orders.end()) orders.push_back(0);
    std::sort(orders.begin(), orders.end());
    return orders;
}

double efficiency_of(const diffraction::Grating& grating, int order, double wavelength_nm, double s_g = 0.0) {
    return order == 0 ? diffraction::zero_order_efficiency(grating, wavelength_nm)
                      : diffraction::order_efficiency(grating, order, wavelength_nm, s_g);
}

double absorbed_fraction(const diffraction::Grating& grating, double wavelength_nm, double s_g) {
    if (const auto* table = std::get_if<diffraction::EfficiencyTable>(&grating.profile)) {
        double reflected = 0.0;
        for (const int order : table->orders)
            reflected += diffraction::profile_efficiency(grating.profile, grating.pitch_nm, order, wavelength_nm, s_g);
        return std::max(0.0, 1.0 - reflected);
    }
    return 1.0 - diffraction::reflectance(grating, wavelength_nm);
}

}  // namespace

AngleCurve angle_curve(const diffraction::Grating& grating, double wavelength_nm, double incidence_deg, int samples) {
    glm::dvec3 s = direction(incidence_deg);
    if (grating.transmission) s.z = -s.z;
    const auto brdf = [&](double angle_deg) {
        return diffraction::brdf_energy(grating, s, direction(angle_deg), wavelength_nm);
    };
    AngleCurve curve;
    std::vector<double> angles;
    for (int i = 0; i < samples; ++i) angles.push_back(-90.0 + 180.0 * i / (samples - 1));
    const double width = wavelength_nm / (grating.grooves * grating.pitch_nm);  // of a peak, in v_g
    for (const int order : shown_orders(grating)) {
        const auto v_g = diffraction::diffracted_cosine(s.x, order, wavelength_nm, grating.pitch_nm);
        if (!v_g) continue;
        const double angle = std::asin(*v_g) / kDegree;
        curve.peaks.push_back({order, angle, efficiency_of(grating, order, wavelength_nm, s.x), brdf(angle)});
        for (int i = -8; i <= 8; ++i) {
            const double near = *v_g + i * width / 4.0;
            if (std::abs(near) < 1.0) angles.push_back(std::asin(near) / kDegree);
        }
    }
    std::sort(angles.begin(), angles.end());
    for (const double angle : angles) curve.points.emplace_back(angle, brdf(angle));
    std::sort(curve.peaks.begin(), curve.peaks.end(),
              [](const OrderPeak& a, const OrderPeak& b) { return a.angle_deg < b.angle_deg; });
    return curve;
}

std::vector<EfficiencyCurve> efficiency_curves(const diffraction::Grating& grating, std::size_t most) {
    constexpr int kStep = 4;
    std::vector<std::pair<double, EfficiencyCurve>> curves;  // with the negative sum; the mirror's order is the first
    for (const int order : shown_orders(grating)) {
        EfficiencyCurve curve{order, {}};
        double sum = 0.0;
        for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; nm += kStep) {
            curve.points.emplace_back(nm, efficiency_of(grating, order, nm));
            sum += curve.points.back().y;
        }
        curves.emplace_back(order == 0 ? -HUGE_VAL : -sum, std::move(curve));
    }
    std::stable_sort(curves.begin(), curves.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    if (curves.size() > most) curves.resize(most);
    std::sort(curves.begin(), curves.end(),
              [](const auto& a, const auto& b) { return a.second.order < b.second.order; });
    std::vector<EfficiencyCurve> result;
    for (auto& [sum, curve] : curves) result.push_back(std::move(curve));
    return result;
}

EnergyBalance energy_balance(diffraction::Grating grating, double wavelength_nm, double s_g) {
    grating.normalization = diffraction::Normalization::Energy;
    EnergyBalance balance{.zero = diffraction::zero_order_efficiency(grating, wavelength_nm),
                          .absorbed = absorbed_fraction(grating, wavelength_nm, s_g)};
    for (const int order : grating.orders) {
        if (order == 0) continue;
        const bool leaves = diffraction::diffracted_cosine(s_g, order, wavelength_nm, grating.pitch_nm).has_value();
        (leaves ? balance.orders : balance.evanescent) += efficiency_of(grating, order, wavelength_nm, s_g);
    }
    balance.rest = std::max(0.0, 1.0 - balance.orders - balance.zero - balance.evanescent - balance.absorbed);
    return balance;
}

std::vector<OrderTrace> order_directions(const diffraction::Grating& grating, const glm::dvec3& s) {
    constexpr int kStep = 5;
    std::vector<OrderTrace> traces;
    for (const int order : shown_orders(grating)) {
        OrderTrace trace{order, {}};
        for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; nm += kStep) {
            const auto v_g = diffraction::diffracted_cosine(s.x, order, nm, grating.pitch_nm);
            if (v_g && *v_g * *v_g + s.y * s.y < 1.0) trace.spots.push_back({static_cast<double>(nm), *v_g, -s.y});
        }
        if (!trace.spots.empty()) traces.push_back(std::move(trace));
    }
    return traces;
}

KernelStrip kernel_strip(const diffraction::KernelTable& kernel, double pitch_nm, int cells) {
    KernelStrip strip{.begin_nm = std::max(kernel.begin_nm, -2.0 * pitch_nm),
                      .end_nm = std::min(kernel.end_nm, 2.0 * pitch_nm),
                      .xyz = {}};
    if (!(strip.begin_nm < strip.end_nm)) return strip;
    const double cell = (strip.end_nm - strip.begin_nm) / cells;
    for (int i = 0; i < cells; ++i) {
        const double begin = strip.begin_nm + i * cell;
        strip.xyz.push_back(kernel.average(begin, begin + cell) * glm::dvec3(1.0));
    }
    return strip;
}

}  // namespace rowland::inspector
