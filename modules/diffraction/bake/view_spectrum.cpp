#include "modules/diffraction/bake/view_spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/math/sh_basis.h"
#include "modules/diffraction/model/efficiency.h"

namespace rowland::diffraction {

void require_many_grooves(const Grating& grating) {
    if (grating.grooves >= kManyGrooves) return;
    throw Error({.file = {},
                 .location = "grooves",
                 .found = fmt::format("{}", grating.grooves),
                 .expected = fmt::format("at least {} for a baked representation", kManyGrooves),
                 .remedy = "use the method \"reference\", or more grooves"});
}

ViewSpectrum::ViewSpectrum(const Grating& grating, int bands)
    : pitch_nm_(grating.pitch_nm),
      lattice_orders_(grating.lattice ? shaded_lattice_orders(grating) : std::vector<LatticeOrder>{}),
      orders_(grating.orders),
      cover_(grating.cover),
      arcs_(bands, grating.lobe, grating.cover) {
    ROWLAND_CHECK_OP(grating.pitch_nm, >, 0.0);
    require_many_grooves(grating);
    std::vector<double> totals(kWavelengths, 0.0);
    for (const LatticeOrder& order : lattice_orders_)
        std::transform(totals.begin(), totals.end(), order.efficiency.begin(), totals.begin(), std::plus<>());
    for (const int order : orders_) {
        for (std::size_t j = 0; j < kWavelengths; ++j) {
            const double wavelength_nm = colour::kVisibleMin + static_cast<double>(j);
            efficiencies_.push_back(order_efficiency(grating, order, wavelength_nm));
            totals[j] += efficiencies_.back();
        }
    }
    largest_efficiency_ = *std::max_element(totals.begin(), totals.end());
}

std::vector<double> ViewSpectrum::coefficients(double v_g, double v_h) const {
    if (!lattice_orders_.empty()) return lattice_spectrum(lattice_orders_, cover_, {v_g, v_h}, bands());
    const auto count = static_cast<std::size_t>(math::sh_count(bands()));
    std::vector<double> arcs(kWavelengths * count, 0.0);
    for (std::size_t k = 0; k < orders_.size(); ++k) {
        for (std::size_t j = 0; j < kWavelengths; ++j) {
            const double wavelength_nm = colour::kVisibleMin + static_cast<double>(j);
            arcs_.accumulate(orders_[k] * wavelength_nm / pitch_nm_ - v_g, v_h, wavelength_nm,
                             efficiencies_[k * kWavelengths + j], std::span(arcs).subspan(j * count, count));
        }
    }
    std::vector<double> result(arcs.size());
    for (std::size_t j = 0; j < kWavelengths; ++j)
        arcs_.to_tangent_frame(std::span<const double>(arcs).subspan(j * count, count),
                               std::span(result).subspan(j * count, count));
    return result;
}

}  // namespace rowland::diffraction
