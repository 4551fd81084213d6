#include "modules/diffraction/rigorous/solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "modules/diffraction/rigorous/modes.h"

namespace rowland::diffraction {

namespace {

/// Power of each scattered mode per power of each incident one: row by incident, column by scattered.
std::vector<double> powers(const Eigen::MatrixXcd& amplitudes, int first, const Eigen::VectorXd& to,
                           const Eigen::VectorXd& from, double flux_ratio) {
    std::vector<double> result;
    for (int i = 0; i < from.size(); ++i)
        for (int j = 0; j < to.size(); ++j)
            result.push_back(std::norm(amplitudes(first + j, i)) * to[j] / from[i] * flux_ratio);
    return result;
}

double entry(const std::vector<double>& te, const std::vector<double>& tm, std::size_t row, std::size_t column,
             std::size_t columns, Light light) {
    const std::size_t i = row * columns + column;
    if (light == Light::Unpolarised) return (te[i] + tm[i]) / 2.0;
    return light == Light::TE ? te[i] : tm[i];
}

/// Largest difference of the rows for light from the s_g asked for.
double largest_change(const OrderEfficiencies& a, const OrderEfficiencies& b) {
    double largest = 0.0;
    const auto compare = [&](double x, double y) {
        // Also larger than everything if one is not a number.
        if (!(std::abs(x - y) <= largest)) largest = std::isfinite(x - y) ? std::abs(x - y) : 1e300;
    };
    for (const Light light : {Light::TE, Light::TM}) {
        for (int j = 0; j < static_cast<int>(a.v_g.size()); ++j)
            compare(a.reflected(a.first + j, light), b.reflected(a.first + j, light));
        for (int j = 0; j < static_cast<int>(a.transmitted_v_g.size()); ++j)
            compare(a.transmitted(a.transmitted_first + j, light), b.transmitted(a.transmitted_first + j, light));
    }
    return largest;
}

void check_light(const Relief& relief, std::complex<double> substrate_index, double wavelength_nm, double s_g) {
    check_relief(relief, "relief");
    if (!(wavelength_nm > 0.0 && wavelength_nm < 1e5))
        refuse_input("light", "wavelength_nm", fmt::format("{}", wavelength_nm), "a number between 0 and 1e5");
    if (!(std::abs(s_g) < 1.0))
        refuse_input("light", "s_g", fmt::format("{}", s_g), "a direction above the surface: between -1 and 1");
    if (!(substrate_index.real() > 0.0 && substrate_index.imag() >= 0.0 && std::abs(substrate_index) < 100.0))
        refuse_input("substrate", "index", fmt::format("{} + {} i", substrate_index.real(), substrate_index.imag()),
                     "n + ik with n > 0 and k >= 0: a medium without gain", "give k as a number that is not negative");
}

/// Turns the solution of a relief into that of the relief mirrored along g, for light from the opposite s_g.
void mirror(OrderEfficiencies& solved) {
    const auto mirror_directions = [](std::vector<double>& v_g, int& first) {
        std::reverse(v_g.begin(), v_g.end());
        for (double& direction : v_g) direction = -direction;
        first = 1 - first - static_cast<int>(v_g.size());
    };
    mirror_directions(solved.v_g, solved.first);
    mirror_directions(solved.transmitted_v_g, solved.transmitted_first);
    for (auto* table : {&solved.reflected_te, &solved.reflected_tm, &solved.transmitted_te, &solved.transmitted_tm})
        std::reverse(table->begin(), table->end());  // rows and columns
}

}  // namespace

double OrderEfficiencies::reflected(int order, Light light, int k) const {
    const int row = k - first;
    const int column = row + order;
    const auto size = static_cast<int>(v_g.size());
    if (row < 0 || row >= size || column < 0 || column >= size) return 0.0;
    return entry(reflected_te, reflected_tm, static_cast<std::size_t>(row), static_cast<std::size_t>(column),
                 v_g.size(), light);
}

double OrderEfficiencies::transmitted(int order, Light light, int k) const {
    const int row = k - first;
    const int column = k + order - transmitted_first;
    if (row < 0 || row >= static_cast<int>(v_g.size()) || column < 0 ||
        column >= static_cast<int>(transmitted_v_g.size()))
        return 0.0;
    return entry(transmitted_te, transmitted_tm, static_cast<std::size_t>(row), static_cast<std::size_t>(column),
                 transmitted_v_g.size(), light);
}

double OrderEfficiencies::sum(Light light, int k) const {
    double total = 0.0;
    for (int j = 0; j < static_cast<int>(v_g.size()); ++j) total += reflected(first + j - k, light, k);
    for (int j = 0; j < static_cast<int>(transmitted_v_g.size()); ++j)
        total += transmitted(transmitted_first + j - k, light, k);
    return total;
}

double through_sheet(const OrderEfficiencies& solved, int order, double ior, Light light, int k) {
    if (light == Light::Unpolarised)
        return 0.5 *
               (through_sheet(solved, order, ior, Light::TE, k) + through_sheet(solved, order, ior, Light::TM, k));
    const int column = k + order - solved.transmitted_first;
    if (column < 0 || column >= static_cast<int>(solved.transmitted_v_g.size())) return 0.0;
    const double sine = solved.transmitted_v_g[static_cast<std::size_t>(column)];
    if (std::abs(sine) >= 1.0) return 0.0;
    const double in_air = std::sqrt(1.0 - sine * sine);
    const double inside = std::sqrt(1.0 - sine * sine / (ior * ior));
    const double a = light == Light::TE ? ior * inside : inside;
    const double b = light == Light::TE ? in_air : ior * in_air;
    return 4.0 * a * b / ((a + b) * (a + b)) * solved.transmitted(order, light, k);
}

double leaving(const OrderEfficiencies& solved, int order, const Substrate& substrate, Light light, int k) {
    if (const auto* ior = std::get_if<double>(&substrate)) return through_sheet(solved, order, *ior, light, k);
    return solved.reflected(order, light, k);
}

OrderEfficiencies solve(const Relief& relief, std::complex<double> substrate_index, double wavelength_nm, double s_g,
                        int truncation) {
    check_light(relief, substrate_index, wavelength_nm, s_g);
    ROWLAND_CHECK(truncation >= 0 && truncation <= kMaximumTruncation, "a truncation within its limits");
    if (relief.mirrored) s_g = -s_g;
    const double step = wavelength_nm / relief.pitch_nm;
    const int centre = static_cast<int>(std::lround(s_g / step));
    Basis basis{.wavelength_nm = wavelength_nm, .period = 2.0 * std::numbers::pi / step, .alpha = {}};
    basis.alpha.resize(2 * truncation + 1);
    for (int q = 0; q <= 2 * truncation; ++q) basis.alpha[q] = (centre + q - truncation) * step - s_g;

    const bool translated = std::visit([](const auto& shape) { return shape.depth_nm > 0.0; }, relief.shape) &&
                            !std::holds_alternative<LamellarProfile>(relief.shape);
    const Stack stack =
        translated ? translated_stack(relief, substrate_index, basis) : lamellar_stack(relief, substrate_index, basis);
    const Propagating up = propagating(basis, relief.ambient_ior);
    const Propagating down = propagating(basis, substrate_index);
    OrderEfficiencies result;
    for (int i = 0; i < up.gamma.size(); ++i) result.v_g.push_back(basis.alpha[up.first + i]);
    for (int i = 0; i < down.gamma.size(); ++i) result.transmitted_v_g.push_back(basis.alpha[down.first + i]);
    result.first = centre - truncation + up.first;
    result.transmitted_first = centre - truncation + down.first;
    for (const Polarisation polarisation : {Polarisation::TE, Polarisation::TM}) {
        const bool te = polarisation == Polarisation::TE;
        const Scattered scattered = scatter(stack.modes[static_cast<int>(polarisation)], down.gamma.size() > 0);
        const double ratio = te ? 1.0 : relief.ambient_ior * relief.ambient_ior / std::norm(substrate_index);
        (te ? result.reflected_te : result.reflected_tm) = powers(scattered.up, stack.up, up.gamma, up.gamma, 1.0);
        (te ? result.transmitted_te : result.transmitted_tm) =
            powers(scattered.down, stack.down, down.gamma, up.gamma, ratio);
    }
    if (relief.mirrored) mirror(result);
    return result;
}

int first_truncation(const Relief& relief, std::complex<double> substrate_index, double wavelength_nm) {
    double index = std::max(relief.ambient_ior, substrate_index.imag() == 0.0 ? substrate_index.real() : 1.0);
    for (const DielectricFilm& film : relief.films) index = std::max(index, film.ior);
    const double stretch =
        std::visit([&](const auto& shape) { return largest_stretch(shape, relief.pitch_nm); }, relief.shape);
    const int margin = std::holds_alternative<LamellarProfile>(relief.shape) ? 9 : 5;
    return static_cast<int>(std::ceil(stretch * index * relief.pitch_nm / wavelength_nm)) + margin;
}

int truncation_with(int margin, const Relief& relief, std::complex<double> substrate_index, double wavelength_nm) {
    return std::min(first_truncation(relief, substrate_index, wavelength_nm) + margin, kMaximumTruncation);
}

std::vector<CombLight> comb_of(const OrderEfficiencies& solved, double s_g, double period) {
    std::vector<CombLight> comb;
    for (int i = 0; i < static_cast<int>(solved.v_g.size()); ++i) {
        const int k = i + solved.first;
        const double from = s_g - k * period;  // = −v_g[i]
        if (std::abs(from) < 1.0) comb.push_back({k, from});
    }
    return comb;
}

Converged solve_converged(const Relief& relief, std::complex<double> substrate_index, double wavelength_nm, double s_g,
                          double tolerance) {
    check_light(relief, substrate_index, wavelength_nm, s_g);
    int truncation = first_truncation(relief, substrate_index, wavelength_nm);
    const int last = std::min(2 * truncation + 16, kMaximumTruncation);  // beyond, nothing converges any more
    const auto refuse = [&](const std::string& found) {
        refuse_input("rigorous solver",
                     fmt::format("pitch {} nm, wavelength {} nm, s_g {}", relief.pitch_nm, wavelength_nm, s_g), found,
                     fmt::format("changes of at most {} and a sum of at most 1 up to truncation {}", tolerance, last),
                     "reduce the depth or the pitch, allow a larger error, or use scalar theory");
    };
    if (truncation > kMaximumTruncation) refuse(fmt::format("at least {} orders to solve for", 2 * truncation + 1));
    Converged result{solve(relief, substrate_index, wavelength_nm, s_g, truncation), truncation};
    std::string distance;
    for (;;) {
        const int added = std::max(4, truncation / 8);
        truncation += added;
        if (truncation > last) refuse(distance);
        OrderEfficiencies next = solve(relief, substrate_index, wavelength_nm, s_g, truncation);
        const double change = largest_change(result.efficiencies, next);
        const double excess = std::max(next.sum(Light::TE), next.sum(Light::TM)) - 1.0;
        result = {std::move(next), truncation, added, change};
        distance = fmt::format("efficiencies that still change by {:.2g} and sum to {:.7g}", change, 1.0 + excess);
        if (change <= tolerance && excess <= kSumTolerance) return result;
    }
}

ClassicalIncidence classical_incidence(double ambient_ior, double wavelength_nm, double s_g, double s_h) {
    const double scale = std::sqrt(1.0 - s_h * s_h / (ambient_ior * ambient_ior));
    return {wavelength_nm / scale, s_g / scale};
}

}  // namespace rowland::diffraction
