#include "engine/lighting/key_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/math/spherical_harmonics.h"

namespace rowland::lighting {

namespace {

using std::numbers::pi;

/// From this concentration on the recurrence in l runs upward: it loses exp(l²/κ), at most 4 digits at 32 bands.
constexpr double kUpwardConcentration = 120.0;

/// The downward recurrence starts this many bands above the last one. Below kUpwardConcentration each step multiplies
/// the error of the start by the square of the ratio, by 1e-30 in all.
constexpr int kHeadStart = 160;

std::vector<double> factors_upward(double concentration, int bands) {
    std::vector<double> factors{1.0, 1.0 / std::tanh(concentration) - 1.0 / concentration};
    for (int l = 1; l + 1 < bands; ++l) {
        const auto i = static_cast<std::size_t>(l);
        factors.push_back(factors[i - 1] - (2 * l + 1) / concentration * factors[i]);
    }
    factors.resize(static_cast<std::size_t>(bands));
    return factors;
}

std::vector<double> factors_downward(double concentration, int bands) {
    // ratio_l = I_{l+½}/I_{l−½} = 1/((2l+1)/κ + ratio_{l+1}).
    std::vector<double> factors(static_cast<std::size_t>(bands), 1.0);
    double ratio = 0.0;
    for (int l = bands + kHeadStart; l >= 1; --l) {
        ratio = 1.0 / ((2 * l + 1) / concentration + ratio);
        if (l < bands) factors[static_cast<std::size_t>(l)] = ratio;
    }
    for (std::size_t l = 1; l < factors.size(); ++l) factors[l] *= factors[l - 1];
    return factors;
}

double normal_pdf(double x) {
    return std::exp(-0.5 * x * x) / std::sqrt(2.0 * pi);
}

double normal_cdf(double x) {
    return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

}  // namespace

double lobe_density(const KeyLight& key, const glm::dvec3& s) {
    // 1 − cos from the chord, which does not cancel for narrow lobes.
    const glm::dvec3 chord = s - key.direction;
    const double peak = key.concentration / (-2.0 * pi * std::expm1(-2.0 * key.concentration));
    return peak * std::exp(-0.5 * key.concentration * glm::dot(chord, chord));
}

std::vector<double> lobe_band_factors(double concentration, int bands) {
    ROWLAND_CHECK_OP(concentration, >, 0.0);
    ROWLAND_CHECK_OP(bands, >=, 1);
    return concentration > kUpwardConcentration ? factors_upward(concentration, bands)
                                                : factors_downward(concentration, bands);
}

ShLight project(std::span<const KeyLight> keys, int bands) {
    const auto count = static_cast<std::size_t>(math::sh_count(bands));
    ShLight light{.bands = bands, .coefficients = std::vector<glm::dvec3>(count, glm::dvec3(0.0))};
    std::vector<double> basis(count);
    for (const KeyLight& key : keys) {
        const std::vector<double> factors = lobe_band_factors(key.concentration, bands);
        math::evaluate_sh(key.direction, bands, basis);
        for (int l = 0; l < bands; ++l)
            for (int m = -l; m <= l; ++m) {
                const auto i = static_cast<std::size_t>(math::sh_index(l, m));
                light.coefficients[i] += factors[static_cast<std::size_t>(l)] * basis[i] * key.flux;
            }
    }
    return light;
}

ShLight residual(const ShLight& probe, std::span<const KeyLight> keys, int bands) {
    ShLight light = limit_bands(probe, bands);
    const ShLight lobes = project(keys, bands);
    for (std::size_t i = 0; i < light.coefficients.size(); ++i) light.coefficients[i] -= lobes.coefficients[i];
    return light;
}

LobeMoments lobe_moments(double concentration) {
    const std::vector<double> factors = lobe_band_factors(concentration, 3);
    LobeMoments moments{.mean = factors[1], .variance_along = 0.0, .variance_across = factors[1] / concentration};
    // 1 − A₁² − 2A₁/κ cancels for narrow lobes, where it is 1/κ² to exp(−2κ).
    moments.variance_along = concentration > 20.0 ? 1.0 / (concentration * concentration)
                                                  : 1.0 - moments.mean * moments.mean - 2.0 * moments.variance_across;
    return moments;
}

ClampedNormal clamp_normal(double mean, double deviation) {
    // Beyond 12 σ below 0 the moments underflow.
    if (mean < -12.0 * deviation) return {};
    if (deviation <= 0.0) return {.mean = mean, .weighted_mean = mean, .weighted_variance = 0.0};
    const double z = mean / deviation;
    const double above = normal_cdf(z);  // probability of x > 0
    const double density = deviation * normal_pdf(z);
    const double variance = deviation * deviation;
    const double first = mean * above + density;
    if (!(first > 1e-12 * deviation)) return {};
    const double second = (mean * mean + variance) * above + mean * density;
    const double third = mean * (mean * mean + 3.0 * variance) * above + (mean * mean + 2.0 * variance) * density;
    const double weighted_mean = second / first;
    return {.mean = first,
            .weighted_mean = weighted_mean,
            .weighted_variance = std::max(0.0, third / first - weighted_mean * weighted_mean)};
}

LobeIrradiance::LobeIrradiance(std::span<const KeyLight> keys) : keys_(keys) {
    for (const KeyLight& key : keys) moments_.push_back(lobe_moments(key.concentration));
}

glm::dvec3 LobeIrradiance::operator()(const glm::dvec3& normal) const {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        const LobeMoments& moments = moments_[i];
        const double c = glm::dot(keys_[i].direction, normal);
        const double variance = c * c * moments.variance_along + (1.0 - c * c) * moments.variance_across;
        sum += clamp_normal(c * moments.mean, std::sqrt(std::max(0.0, variance))).mean * keys_[i].flux;
    }
    return sum;
}

}  // namespace rowland::lighting
