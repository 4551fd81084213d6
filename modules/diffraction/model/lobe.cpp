#include "modules/diffraction/model/lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/colour/spectrum.h"
#include "modules/diffraction/model/profile.h"

namespace rowland::diffraction {

namespace {

constexpr double kWholeDomain = LobeExtent{}.half_width;

/// Half the width of a Gaussian in σ: exp(−8.4²/2) = 5e-16.
constexpr double kGaussianReach = 8.4;

double gaussian_half_width(double sigma) {
    return std::min(kGaussianReach * sigma, kWholeDomain);
}

LobeExtent extent(const FlatLobe&) {
    return {};
}

LobeExtent extent(const GaussianLobe& lobe) {
    const double half_width = gaussian_half_width(lobe.sigma);
    return {
        .half_width = half_width, .core_half_width = half_width, .feature_size = std::min(lobe.sigma, kWholeDomain)};
}

LobeExtent extent(const PitsLobe& lobe) {
    LobeExtent result = lobe.coherent > 0.0 ? extent(GaussianLobe{kCoherentSigma}) : LobeExtent{};
    if (lobe.coherent == 1.0) return result;
    result.half_width = kWholeDomain;
    // A period of sinc² at the shortest wavelength.
    result.tail_feature_size = std::min(colour::kVisibleMin / lobe.length_nm, kWholeDomain);
    result.feature_size = std::min(result.feature_size, result.tail_feature_size);
    return result;
}

/// The orders are as narrow as the core, and lie everywhere.
LobeExtent extent(const PitSequenceLobe& lobe) {
    if (lobe.coherent == 1.0) return extent(GaussianLobe{lobe.sigma});
    const double feature_size = std::min(lobe.sigma, kWholeDomain);
    return {.feature_size = feature_size, .tail_feature_size = feature_size};
}

/// The least odd number that is not below x.
int odd_from(double x) {
    return 2 * static_cast<int>(std::ceil(0.5 * (x - 1.0))) + 1;
}

}  // namespace

LobeDensity::LobeDensity(const GrooveLobe& lobe, double wavelength_nm) {
    if (const auto* gaussian = std::get_if<GaussianLobe>(&lobe)) {
        add_gaussian(gaussian->sigma, 1.0);
    } else if (const auto* pits = std::get_if<PitsLobe>(&lobe)) {
        add_gaussian(kCoherentSigma, pits->coherent);
        pit_length_over_wavelength_ = pits->length_nm / wavelength_nm;
        pit_peak_ = (1.0 - pits->coherent) * pit_length_over_wavelength_;
    } else if (const auto* sequence = std::get_if<PitSequenceLobe>(&lobe)) {
        add_gaussian(sequence->sigma, 1.0);
        order_peak_ =
            (1.0 - sequence->coherent) * pit_order_power(1) * peak_ / static_cast<double>(sequence->spacings_nm.size());
        peak_ *= sequence->coherent;
        order_half_width_ = kGaussianReach * sequence->sigma;
        for (const double spacing_nm : sequence->spacings_nm)
            pit_spacings_over_wavelength_.push_back(spacing_nm / wavelength_nm);
    } else {
        constant_ = 0.5;
    }
}

void LobeDensity::add_gaussian(double sigma, double fraction) {
    const double inside = std::erf(1.0 / (sigma * std::numbers::sqrt2));
    inverse_sigma_ = 1.0 / sigma;
    peak_ = fraction * std::numbers::inv_sqrtpi / (sigma * std::numbers::sqrt2 * inside);
}

double LobeDensity::pits(double sum_h) const {
    const double amplitude = sinc(pit_length_over_wavelength_ * sum_h);
    return pit_peak_ * amplitude * amplitude;
}

double LobeDensity::pit_sequence(double sum_h) const {
    const double z = std::abs(sum_h);  // both signs sum in the same order, so that D_h is exactly even
    double sum = 0.0;
    for (const double spacing : pit_spacings_over_wavelength_) {
        const double last = (z + order_half_width_) * spacing;
        for (int order = odd_from((z - order_half_width_) * spacing); order <= last; order += 2) {
            const double distance = (z - order / spacing) * inverse_sigma_;
            sum += std::exp(-0.5 * distance * distance) / (static_cast<double>(order) * order);
        }
    }
    return order_peak_ * sum;
}

double pit_order_power(int order) {
    const double amplitude = 2.0 * std::numbers::inv_pi / order;
    return amplitude * amplitude;
}

std::vector<PitOrder> pit_orders(const PitSequenceLobe& lobe, double wavelength_nm, double farthest) {
    std::vector<PitOrder> orders{{.centre = 0.0, .power = lobe.coherent}};
    const double incoherent = (1.0 - lobe.coherent) / static_cast<double>(lobe.spacings_nm.size());
    if (incoherent == 0.0) return orders;
    for (const double spacing_nm : lobe.spacings_nm) {
        const double last = farthest * spacing_nm / wavelength_nm;
        for (int order = odd_from(-last); order <= last; order += 2)
            orders.push_back(
                {.centre = order * wavelength_nm / spacing_nm, .power = incoherent * pit_order_power(order)});
    }
    return orders;
}

double lobe_density(const GrooveLobe& lobe, double sum_h, double wavelength_nm) {
    return LobeDensity(lobe, wavelength_nm)(sum_h);
}

LobeExtent lobe_extent(const GrooveLobe& lobe) {
    return std::visit([](const auto& shape) { return extent(shape); }, lobe);
}

bool is_flat(const GrooveLobe& lobe) {
    return std::holds_alternative<FlatLobe>(lobe);
}

bool depends_on_wavelength(const GrooveLobe& lobe) {
    return std::holds_alternative<PitsLobe>(lobe) || std::holds_alternative<PitSequenceLobe>(lobe);
}

}  // namespace rowland::diffraction
