#include "editor/inspector/physics/angle_curve.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>

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
    return orders;
}

}  // namespace

AngleCurve angle_curve(const diffraction::Grating& grating, double wavelength_nm, double incidence_deg, int samples) {
    const glm::dvec3 s = direction(incidence_deg);
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
        const double efficiency = order == 0 ? diffraction::zero_order_efficiency(grating, wavelength_nm)
                                             : diffraction::order_efficiency(grating, order, wavelength_nm, s.x);
        curve.peaks.push_back({order, angle, efficiency, brdf(angle)});
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

}  // namespace rowland::inspector
