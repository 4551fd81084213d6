#include "modules/diffraction/model/lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/colour/sampled_spectrum.h"
#include "modules/diffraction/model/profile.h"

namespace rowland::diffraction {

namespace {

/// s_h + v_h of two unit vectors.
constexpr double kLargestSum = 2.0;

/// exp(−8.4²/2) = 5e-16.
double gaussian_half_width(double sigma) {
    return std::min(8.4 * sigma, kLargestSum);
}

double core_half_width(const FlatLobe&) {
    return kLargestSum;
}
double core_half_width(const GaussianLobe& lobe) {
    return gaussian_half_width(lobe.sigma);
}
double core_half_width(const PitsLobe& lobe) {
    return lobe.coherent > 0.0 ? gaussian_half_width(kCoherentSigma) : kLargestSum;
}

double half_width(const FlatLobe&) {
    return kLargestSum;
}
double half_width(const GaussianLobe& lobe) {
    return gaussian_half_width(lobe.sigma);
}
double half_width(const PitsLobe& lobe) {
    return lobe.coherent < 1.0 ? kLargestSum : gaussian_half_width(kCoherentSigma);
}

double tail_feature_size(const FlatLobe&) {
    return kLargestSum;
}
double tail_feature_size(const GaussianLobe&) {
    return kLargestSum;
}
/// A period of sinc² at the shortest wavelength.
double tail_feature_size(const PitsLobe& lobe) {
    return lobe.coherent < 1.0 ? std::min(colour::kVisibleMin / lobe.length_nm, kLargestSum) : kLargestSum;
}

double feature_size(const FlatLobe&) {
    return kLargestSum;
}
double feature_size(const GaussianLobe& lobe) {
    return std::min(lobe.sigma, kLargestSum);
}
double feature_size(const PitsLobe& lobe) {
    return std::min(lobe.coherent > 0.0 ? kCoherentSigma : kLargestSum, tail_feature_size(lobe));
}

}  // namespace

LobeDensity::LobeDensity(const GrooveLobe& lobe, double wavelength_nm) {
    if (const auto* gaussian = std::get_if<GaussianLobe>(&lobe)) {
        add_gaussian(gaussian->sigma, 1.0);
    } else if (const auto* pits = std::get_if<PitsLobe>(&lobe)) {
        add_gaussian(kCoherentSigma, pits->coherent);
        pit_wavelengths_ = pits->length_nm / wavelength_nm;
        pit_peak_ = (1.0 - pits->coherent) * pit_wavelengths_;
    } else {
        constant_ = 0.5;
    }
}

void LobeDensity::add_gaussian(double sigma, double share) {
    const double share_inside = std::erf(1.0 / (sigma * std::numbers::sqrt2));
    inverse_sigma_ = 1.0 / sigma;
    peak_ = share * std::numbers::inv_sqrtpi / (sigma * std::numbers::sqrt2 * share_inside);
}

double LobeDensity::pits(double sum_h) const {
    const double amplitude = sinc(pit_wavelengths_ * sum_h);
    return pit_peak_ * amplitude * amplitude;
}

double lobe_density(const GrooveLobe& lobe, double sum_h, double wavelength_nm) {
    return LobeDensity(lobe, wavelength_nm)(sum_h);
}

double lobe_half_width(const GrooveLobe& lobe) {
    return std::visit([](const auto& shape) { return half_width(shape); }, lobe);
}

double lobe_core_half_width(const GrooveLobe& lobe) {
    return std::visit([](const auto& shape) { return core_half_width(shape); }, lobe);
}

double lobe_tail_feature_size(const GrooveLobe& lobe) {
    return std::visit([](const auto& shape) { return tail_feature_size(shape); }, lobe);
}

double lobe_feature_size(const GrooveLobe& lobe) {
    return std::visit([](const auto& shape) { return feature_size(shape); }, lobe);
}

bool is_flat(const GrooveLobe& lobe) {
    return std::holds_alternative<FlatLobe>(lobe);
}

}  // namespace rowland::diffraction
