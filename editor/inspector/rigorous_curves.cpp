#include "editor/inspector/rigorous_curves.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/parallel.h"
#include "modules/diffraction/rigorous/solver.h"

namespace rowland::inspector {

namespace {

using diffraction::Light;
using diffraction::OrderEfficiencies;

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

struct Steps {
    int wavelength_nm;
    double angle_deg;
    int margin;  ///< beyond diffraction::first_truncation()
};

OrderEfficiencies solve_at(const RigorousInputs& inputs, double wavelength_nm, double s_g, int margin) {
    const auto index = diffraction::index_of(inputs.substrate, wavelength_nm);
    return diffraction::solve(inputs.relief, index, wavelength_nm, s_g,
                              diffraction::truncation_with(margin, inputs.relief, index, wavelength_nm));
}

/// The s_g to solve for at one wavelength. A solve gives light from s_g + kλ/d for all k; together the solves have
/// incidences that are at most `angle_deg` apart near normal incidence.
std::vector<double> comb_starts(const RigorousInputs& inputs, double angle_deg) {
    const double period = std::min(inputs.wavelength_nm / inputs.relief.pitch_nm, 2.0);
    const int count = std::max(1, static_cast<int>(std::ceil(period / (angle_deg * kRadiansPerDegree))));
    std::vector<double> starts;
    for (int i = 0; i < count; ++i) {
        const double start = period * ((i + 0.5) / count - 0.5);
        if (std::abs(start) < 1.0) starts.push_back(start);
    }
    return starts;
}

/// `at`: wavelength or angle.
PolarisedPoint point_of(const OrderEfficiencies& solved, int order, const diffraction::Substrate& substrate, double at,
                        int k = 0) {
    return {at, leaving(solved, order, substrate, Light::TE, k), leaving(solved, order, substrate, Light::TM, k)};
}

void add_incidences(const OrderEfficiencies& solved, double s_g, double period, const diffraction::Substrate& substrate,
                    std::vector<RigorousOrder>& curves) {
    for (const auto [k, from] : diffraction::comb_of(solved, s_g, period))
        for (RigorousOrder& curve : curves)
            if (std::abs(curve.order * period - from) < 1.0)
                curve.over_incidence.push_back(
                    point_of(solved, curve.order, substrate, std::asin(from) / kRadiansPerDegree, k));
}

std::optional<std::vector<RigorousOrder>> curves_at(const RigorousInputs& inputs, const Steps& steps,
                                                    const std::stop_token& stop) {
    std::vector<std::pair<double, double>> lights;  // wavelength and s_g
    for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; nm += steps.wavelength_nm)
        lights.emplace_back(nm, inputs.s_g);
    const std::size_t wavelengths = lights.size();
    for (const double s_g : comb_starts(inputs, steps.angle_deg)) lights.emplace_back(inputs.wavelength_nm, s_g);
    std::vector<OrderEfficiencies> solved(lights.size());
    parallel_for(lights.size(), [&](std::size_t i) {
        if (!stop.stop_requested()) solved[i] = solve_at(inputs, lights[i].first, lights[i].second, steps.margin);
    });
    if (stop.stop_requested()) return std::nullopt;
    std::vector<RigorousOrder> curves;
    for (const int order : inputs.orders) curves.push_back({order, {}, {}});
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const auto [wavelength_nm, s_g] = lights[i];
        const double period = wavelength_nm / inputs.relief.pitch_nm;
        if (i >= wavelengths) {
            add_incidences(solved[i], s_g, period, inputs.substrate, curves);
            continue;
        }
        for (RigorousOrder& curve : curves)
            if (std::abs(curve.order * period - s_g) < 1.0)
                curve.over_wavelength.push_back(point_of(solved[i], curve.order, inputs.substrate, wavelength_nm));
    }
    for (RigorousOrder& curve : curves) std::ranges::sort(curve.over_incidence, {}, &PolarisedPoint::at);
    return curves;
}

}  // namespace

std::optional<std::vector<RigorousOrder>> rigorous_curves(
    const RigorousInputs& inputs, const std::stop_token& stop,
    const std::function<void(std::vector<RigorousOrder>)>& publish) {
    const auto violet = diffraction::index_of(inputs.substrate, colour::kVisibleMin);
    if (diffraction::first_truncation(inputs.relief, violet, colour::kVisibleMin) > diffraction::kMaximumTruncation)
        solve_converged(inputs.relief, violet, colour::kVisibleMin, inputs.s_g);  // refuses
    auto coarse = curves_at(inputs, {.wavelength_nm = 50, .angle_deg = 6.0, .margin = 0}, stop);
    if (!coarse) return std::nullopt;
    publish(*std::move(coarse));
    const auto index = diffraction::index_of(inputs.substrate, inputs.wavelength_nm);
    const diffraction::Converged converged =
        solve_converged(inputs.relief, index, inputs.wavelength_nm, inputs.s_g, 2e-3);
    const int margin = converged.truncation - diffraction::first_truncation(inputs.relief, index, inputs.wavelength_nm);
    return curves_at(inputs, {.wavelength_nm = 10, .angle_deg = 1.5, .margin = margin}, stop);
}

}  // namespace rowland::inspector
