#include "modules/diffraction/bake/view_spectrum.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/matrix.hpp>

#include "engine/colour/spectrum.h"
#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

namespace {

/// Two Gauss–Legendre nodes on [0, 1], each of weight ½.
constexpr std::array<double, 2> kNodes = {0.21132486540518711775, 0.78867513459481288225};

}  // namespace

TransferTerms::TransferTerms(const Grating& grating, const colour::LightSpectra& spectra, int bands)
    : grating_(grating),
      by_moments_(has_arc_moments(grating)),
      arcs_(bands, grating.lobe, grating.cover),
      moments_(bands) {
    ROWLAND_CHECK_OP(grating.pitch_nm, >, 0.0);
    require_many_grooves(grating);
    if (grating.lattice) lattice_.emplace(grating, spectra, bands);
    for (std::size_t j = 0; j < kWavelengths; ++j)
        observed_.push_back(observed_spectra(spectra, colour::kVisibleMin + static_cast<double>(j)));
    if (depends_on_direction(grating)) return;
    for (const int order : grating.orders) weights_.push_back(weights(order, 0.0));
}

std::vector<glm::dmat3> TransferTerms::weights(int order, double v_g) const {
    std::vector<glm::dmat3> result(kWavelengths);
    for (std::size_t j = 0; j < kWavelengths; ++j)
        result[j] = order_efficiency(grating_, order, colour::kVisibleMin + static_cast<double>(j), v_g) * observed_[j];
    return result;
}

template <typename Use>
void TransferTerms::each_arc(double v_g, double pitch_nm, const Use& use) const {
    for (std::size_t k = 0; k < grating_.orders.size(); ++k) {
        const int order = grating_.orders[k];
        const double slope = order / pitch_nm;
        const std::vector<glm::dmat3> of_view = weights_.empty() ? weights(order, v_g) : std::vector<glm::dmat3>();
        const std::vector<glm::dmat3>& of_order = weights_.empty() ? of_view : weights_[k];
        const auto weight_at = [&](double position) {
            const auto j = std::min(static_cast<std::size_t>(position), kWavelengths - 2);
            const double t = position - static_cast<double>(j);
            return (1.0 - t) * of_order[j] + t * of_order[j + 1];
        };
        if (order == 0) {
            for (std::size_t j = 0; j < kWavelengths; ++j)
                use(-v_g, colour::kVisibleMin + static_cast<double>(j),
                    (j == 0 || j + 1 == kWavelengths ? 0.5 : 1.0) * of_order[j]);
            continue;
        }
        for (std::size_t j = 0; j + 1 < kWavelengths; ++j) {
            const double wavelength_nm = colour::kVisibleMin + static_cast<double>(j);
            const double begin = std::clamp(slope * wavelength_nm - v_g, -1.0, 1.0);
            const double end = std::clamp(slope * (wavelength_nm + 1.0) - v_g, -1.0, 1.0);
            if (begin == end) continue;
            // The coefficients have a square root at the horizon in a = cos ϑ, but not in ϑ.
            const double angle = std::acos(begin);
            const double length = std::acos(end) - angle;
            for (const double node : kNodes) {
                const double at = angle + length * node;
                const double a = std::cos(at);
                const double wavelength_at = std::clamp((a + v_g) / slope, wavelength_nm, wavelength_nm + 1.0);
                const double step_nm = 0.5 * std::abs(length * std::sin(at) / slope);
                use(a, wavelength_at, step_nm * weight_at(wavelength_at - colour::kVisibleMin));
            }
        }
    }
}

std::vector<glm::dmat3> TransferTerms::coefficients(double v_g, double v_h, double pitch_factor) const {
    if (lattice_) return lattice_->coefficients({v_g, v_h});
    if (!by_moments_) return summed_arcs(v_g, v_h, pitch_factor);
    // Fewer functions of a, and no quadrature along the arc.
    const std::vector<glm::dmat3> terms = moments(v_g, pitch_factor);
    const auto count = static_cast<std::size_t>(math::sh_count(arcs_.bands()));
    std::vector<glm::dmat3> result(count, glm::dmat3(0.0));
    for (std::size_t k = 0; k < terms.size(); ++k)
        for (std::size_t i = 0; i < count; ++i) result[i] += moments_.matrix()[k * count + i] * terms[k];
    return result;
}

std::vector<glm::dmat3> TransferTerms::summed_arcs(double v_g, double v_h, double pitch_factor) const {
    const auto count = static_cast<std::size_t>(math::sh_count(arcs_.bands()));
    std::vector<glm::dmat3> arc_frame(count, glm::dmat3(0.0));
    std::vector<double> arc(count);
    each_arc(v_g, grating_.pitch_nm * pitch_factor, [&](double a, double wavelength_nm, const glm::dmat3& weight) {
        std::fill(arc.begin(), arc.end(), 0.0);
        arcs_.accumulate(a, v_h, wavelength_nm, 1.0, arc);
        for (std::size_t i = 0; i < count; ++i)
            if (arc[i] != 0.0) arc_frame[i] += arc[i] * weight;
    });
    std::vector<glm::dmat3> result(count);
    std::vector<double> tangent_frame(count);
    for (int c = 0; c < 3; ++c)
        for (int o = 0; o < 3; ++o) {
            for (std::size_t i = 0; i < count; ++i) arc[i] = arc_frame[i][c][o];
            arcs_.to_tangent_frame(arc, tangent_frame);
            for (std::size_t i = 0; i < count; ++i) result[i][c][o] = tangent_frame[i];
        }
    return result;
}

std::vector<glm::dmat3> TransferTerms::moments(double v_g, double pitch_factor) const {
    ROWLAND_CHECK(by_moments_, "arc moments are those of the flat lobe in air");
    std::vector<glm::dmat3> result(static_cast<std::size_t>(arc_moment_count(moments_.bands())), glm::dmat3(0.0));
    std::vector<double> basis(result.size());
    each_arc(v_g, grating_.pitch_nm * pitch_factor, [&](double a, double, const glm::dmat3& weight) {
        evaluate_arc_basis(a, moments_.bands(), basis);
        for (std::size_t k = 0; k < result.size(); ++k) result[k] += basis[k] * weight;
    });
    return result;
}

void require_many_grooves(const Grating& grating) {
    if (grating.grooves >= kManyGrooves) return;
    throw Error({.file = {},
                 .location = "grooves",
                 .found = fmt::format("{}", grating.grooves),
                 .expected = fmt::format("at least {} for a baked representation", kManyGrooves),
                 .remedy = "use the method \"reference\", or more grooves"});
}

ViewSpectrum::ViewSpectrum(const Grating& grating, int bands)
    : grating_(grating),
      lattice_orders_(grating.lattice ? shaded_lattice_orders(grating) : std::vector<LatticeOrder>{}),
      arcs_(bands, grating.lobe, grating.cover) {
    ROWLAND_CHECK_OP(grating.pitch_nm, >, 0.0);
    require_many_grooves(grating);
    std::vector<double> totals(kWavelengths, 0.0);
    for (const LatticeOrder& order : lattice_orders_)
        std::transform(totals.begin(), totals.end(), order.efficiency.begin(), totals.begin(), std::plus<>());
    for (const int order : grating.orders) {
        for (std::size_t j = 0; j < kWavelengths; ++j) {
            const double wavelength_nm = colour::kVisibleMin + static_cast<double>(j);
            efficiencies_.push_back(order_efficiency(grating, order, wavelength_nm));
            totals[j] += efficiencies_.back();
        }
    }
    largest_efficiency_ = *std::max_element(totals.begin(), totals.end());
}

std::vector<double> ViewSpectrum::coefficients(double v_g, double v_h) const {
    if (!lattice_orders_.empty()) return lattice_spectrum(lattice_orders_, grating_.cover, {v_g, v_h}, bands());
    const auto count = static_cast<std::size_t>(math::sh_count(bands()));
    std::vector<double> arcs(kWavelengths * count, 0.0);
    for (std::size_t k = 0; k < grating_.orders.size(); ++k) {
        const int order = grating_.orders[k];
        for (std::size_t j = 0; j < kWavelengths; ++j) {
            const double wavelength_nm = colour::kVisibleMin + static_cast<double>(j);
            const double efficiency = depends_on_direction(grating_)
                                          ? order_efficiency(grating_, order, wavelength_nm, v_g)
                                          : efficiencies_[k * kWavelengths + j];
            arcs_.accumulate(order * wavelength_nm / grating_.pitch_nm - v_g, v_h, wavelength_nm, efficiency,
                             std::span(arcs).subspan(j * count, count));
        }
    }
    std::vector<double> result(arcs.size());
    for (std::size_t j = 0; j < kWavelengths; ++j)
        arcs_.to_tangent_frame(std::span<const double>(arcs).subspan(j * count, count),
                               std::span(result).subspan(j * count, count));
    return result;
}

}  // namespace rowland::diffraction
