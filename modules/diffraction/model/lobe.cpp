#include "modules/diffraction/model/lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/colour/spectrum.h"
#include "modules/diffraction/model/profile.h"

namespace rowland::diffraction {

namespace {

constexpr double kWholeDomain = LobeExtent{}.half_width;

/// exp(−8.4²/2) = 5e-16.
double gaussian_half_width(double sigma) {
    return std::min(8.4 * sigma, kWholeDomain);
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

}  // namespace

LobeDensity::LobeDensity(const GrooveLobe& lobe, double wavelength_nm) {
    if (const auto* gaussian = std::get_if<GaussianLobe>(&lobe)) {
        add_gaussian(gaussian->sigma, 1.0);
    } else if (const auto* pits = std::get_if<PitsLobe>(&lobe)) {
        add_gaussian(kCoherentSigma, pits->coherent);
        pit_length_over_wavelength_ = pits->length_nm / wavelength_nm;
        pit_peak_ = (1.0 - pits->coherent) * pit_length_over_wavelength_;
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

double lobe_density(const GrooveLobe& lobe, double sum_h, double wavelength_nm) {
    return LobeDensity(lobe, wavelength_nm)(sum_h);
}

LobeExtent lobe_extent(const GrooveLobe& lobe) {
    return std::visit([](const auto& shape) { return extent(shape); }, lobe);
}

bool is_flat(const GrooveLobe& lobe) {
    return std::holds_alternative<FlatLobe>(lobe);
}

}  // namespace rowland::diffraction
