#include "modules/diffraction/representations/direct/lobe_cosine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "engine/math/quadrature.h"

namespace rowland::diffraction {

namespace {

using std::numbers::pi;

/// From this z on there is a closed form.
constexpr double kClosedForm = 3.0;

/// In deviations.
constexpr double kLobeReach = 4.5;

/// ∫₀^π sin t e^(z (cos(t − t₀) − 1)) dt for z ≥ 3, exact in the tails also. `sine` and `cosine`: of t₀, which lies in
/// (−π/2, π/2).
double light_above_narrow(double sine, double cosine, double z) {
    // With τ = t − t₀, sin t = sin τ cos t₀ + cos τ sin t₀: the first term has a closed integral, the second is normal
    // in y = 2√z sin(τ/2), to 1/z².
    const double root = std::sqrt(z);
    const auto gauss = [](double y) { return std::exp(-0.5 * y * y); };
    // 2 cos(t₀/2) and 2 sin(t₀/2) without cancellation.
    const double half_cosine = std::sqrt(2.0 + 2.0 * cosine);
    const double half_sine = 2.0 * sine / half_cosine;
    const double begin = -half_sine * root;
    const double end = half_cosine * root;
    const auto below = [](double y) { return 0.5 * std::erfc(-y / std::numbers::sqrt2); };
    const double above = begin > 0.0 ? below(-begin) - below(-end) : below(end) - below(begin);
    const double second = 3.0 / (8.0 * z);
    const double even =
        (std::sqrt(2.0 * pi) * above * (1.0 - second) + second * (end * gauss(end) - begin * gauss(begin))) / root;
    const double odd = (gauss(begin) - gauss(end)) / z;
    return std::max(0.0, cosine * odd + sine * even);
}

/// light_above_narrow() for smaller z.
double light_above_wide(double sine, double cosine, double z) {
    static const math::QuadratureRule rule = math::gauss_legendre(12, 0.0, pi);
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double height = std::sin(rule.nodes[i]);
        const double along = std::cos(rule.nodes[i]) * cosine + height * sine;
        sum += rule.weights[i] * height * std::exp(z * (along - 1.0));
    }
    return sum;
}

}  // namespace

LobeCosine::LobeCosine(const glm::dvec3& axis, double concentration)
    : concentration_(concentration),
      across_(std::max(std::hypot(axis.y, axis.z), 1e-9)),
      sine_(axis.z / across_),
      cosine_(axis.y / across_),
      middle_(std::atan2(axis.x, across_)),
      scale_(concentration / (-2.0 * pi * std::expm1(-2.0 * concentration))) {}

double LobeCosine::operator()(double psi) const {
    const double cosine = std::cos(psi);
    const double half = std::sin(0.5 * (psi - middle_));
    const double z = concentration_ * cosine * across_;
    // sin t = sin(π − t), so t₀ may be taken in (−π/2, π/2).
    const double above =
        z < kClosedForm ? light_above_wide(sine_, cosine_, z) : light_above_narrow(sine_, std::abs(cosine_), z);
    return scale_ * cosine * cosine * std::exp(-2.0 * concentration_ * half * half) * above;
}

double LobeCosine::deviation() const {
    return 1.0 / std::sqrt(concentration_);
}

double LobeCosine::begin() const {
    return std::max(middle_ - kLobeReach * deviation(), -0.5 * pi);
}

double LobeCosine::end() const {
    return std::min(middle_ + kLobeReach * deviation(), 0.5 * pi);
}

std::vector<LobeSlice> lobe_slices(const LobeCosine& lobe, int count) {
    const double step = (lobe.end() - lobe.begin()) / count;
    std::vector<LobeSlice> slices;
    double begin_g = std::sin(lobe.begin());
    for (int i = 0; i < count; ++i) {
        const double end_g = std::sin(lobe.begin() + (i + 1) * step);
        slices.push_back({step * lobe(lobe.begin() + (i + 0.5) * step), begin_g, end_g});
        begin_g = end_g;
    }
    return slices;
}

std::vector<LobeWindow> lobe_windows(const LobeCosine& lobe) {
    constexpr int kSlices = 48;
    constexpr double kBetween = 0.7;  // of the variance
    constexpr std::array<double, 7> kNodes{-3.750439717725742, -2.366759410734541, -1.154405394739968, 0.0,
                                           1.154405394739968,  2.366759410734541,  3.750439717725742};
    constexpr std::array<double, 7> kWeights{5.48268855972218e-4, 3.07571239675865e-2, 2.40123178605013e-1,
                                             4.57142857142857e-1, 2.40123178605013e-1, 3.07571239675865e-2,
                                             5.48268855972218e-4};
    const double step = (lobe.end() - lobe.begin()) / kSlices;
    std::vector<LobeWindow> windows(kNodes.size());
    std::array<double, kNodes.size()> squares{};
    for (int slice = 0; slice < kSlices; ++slice) {
        const double psi = lobe.begin() + (slice + 0.5) * step;
        const double distance = (psi - lobe.middle()) / lobe.deviation();
        std::array<double, kNodes.size()> parts{};
        double whole = 0.0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const double from = distance - std::sqrt(kBetween) * kNodes[i];
            parts[i] = kWeights[i] * std::exp(-0.5 / (1.0 - kBetween) * from * from);
            whole += parts[i];
        }
        const double light = step * lobe(psi) / whole;
        const double s_g = std::sin(psi);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            windows[i].cosine += light * parts[i];
            windows[i].centre_g += light * parts[i] * s_g;
            squares[i] += light * parts[i] * s_g * s_g;
        }
    }
    for (std::size_t i = 0; i < windows.size(); ++i) {
        if (windows[i].cosine < 1e-30) continue;
        windows[i].centre_g /= windows[i].cosine;
        const double variance = squares[i] / windows[i].cosine - windows[i].centre_g * windows[i].centre_g;
        windows[i].deviation_g = std::sqrt(std::max(0.0, variance));
    }
    std::erase_if(windows, [](const LobeWindow& window) { return window.cosine < 1e-30; });
    return windows;
}

}  // namespace rowland::diffraction
