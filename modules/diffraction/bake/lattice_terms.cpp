#include "modules/diffraction/bake/lattice_terms.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <utility>

#include "engine/math/sh_basis.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/model/efficiency.h"

namespace rowland::diffraction {

namespace {

/// Up to so many orders are summed one by one.
constexpr std::size_t kFewOrders = 100;

/// Points of the pattern this far apart are one for harmonics of so many bands: 1e-4 of the highest.
double cell_of(int bands) {
    return std::max(0.03 / bands, 0.004);
}

/// The part above the horizon of light that the pattern spreads over `length` along u.
struct SeenPart {
    glm::dvec3 s{0.0};      ///< toward its middle
    double fraction = 0.0;  ///< of the whole
};

SeenPart seen_part(const glm::dvec2& u, double length, const glm::dvec2& view) {
    const double distance = glm::length(u);
    const glm::dvec2 along = distance > 0.0 ? u / distance : glm::dvec2(1.0, 0.0);
    // u = 0, the mirror's direction, is above the horizon, so the part is what is nearer than where |u − v| = 1.
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
    : orders_(shaded_lattice_orders(grating)), cover_(grating.cover), cell_(cell_of(bands)), bands_(bands) {
    for (std::size_t j = 0; j < kWavelengths; ++j)
        observed_.push_back((j == 0 || j + 1 == kWavelengths ? 0.5 : 1.0) *
                            observed_spectra(spectra, colour::kVisibleMin + static_cast<double>(j)));
    if (orders_.size() <= kFewOrders) return;
    // Divided linearly among the four nodes of a grid around a point, which keeps each colour's mean direction.
    std::map<std::pair<int, int>, glm::dmat3> grid;
    for (const LatticeOrder& order : orders_)
        for (std::size_t j = 0; j < kWavelengths; ++j) {
            const glm::dvec2 at = (colour::kVisibleMin + static_cast<double>(j)) / cell_ * order.u_per_nm;
            if (cell_ * glm::length(at) > 2.0) break;
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
    for (const auto& [at, weight] : grid) points_.push_back({cell_ * glm::dvec2(at.first, at.second), weight});
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
        const SeenPart part = seen_part(point.u, cell_, view);
        if (part.fraction == 0.0) continue;
        math::evaluate_sh(part.s, bands_, basis);
        add(basis.data(), part.fraction * transmittance(cover_, part.s.z) * point.weight);
    }
    return result;
}

}  // namespace rowland::diffraction
