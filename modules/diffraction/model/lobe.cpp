#include "modules/diffraction/model/lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rowland::diffraction {

namespace {

/// s_h + v_h of two unit vectors.
constexpr double kLargestSum = 2.0;

double half_width(const FlatLobe&) {
    return kLargestSum;
}

/// exp(−8.4²/2) = 5e-16.
double half_width(const GaussianLobe& lobe) {
    return std::min(8.4 * lobe.sigma, kLargestSum);
}

double feature_size(const FlatLobe&) {
    return kLargestSum;
}
double feature_size(const GaussianLobe& lobe) {
    return std::min(lobe.sigma, kLargestSum);
}

}  // namespace

LobeDensity::LobeDensity(const GrooveLobe& lobe, double) {
    if (const auto* gaussian = std::get_if<GaussianLobe>(&lobe)) {
        const double share_inside = std::erf(1.0 / (gaussian->sigma * std::numbers::sqrt2));
        inverse_sigma_ = 1.0 / gaussian->sigma;
        peak_ = std::numbers::inv_sqrtpi / (gaussian->sigma * std::numbers::sqrt2 * share_inside);
    } else {
        constant_ = 0.5;
    }
}

double lobe_density(const GrooveLobe& lobe, double sum_h, double wavelength_nm) {
    return LobeDensity(lobe, wavelength_nm)(sum_h);
}

double lobe_half_width(const GrooveLobe& lobe) {
    return std::visit([](const auto& shape) { return half_width(shape); }, lobe);
}

double lobe_feature_size(const GrooveLobe& lobe) {
    return std::visit([](const auto& shape) { return feature_size(shape); }, lobe);
}

bool is_flat(const GrooveLobe& lobe) {
    return std::holds_alternative<FlatLobe>(lobe);
}

}  // namespace rowland::diffraction
