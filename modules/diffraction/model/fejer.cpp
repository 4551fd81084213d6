#include "modules/diffraction/model/fejer.h"

#include <cmath>
#include <numbers>

namespace rowland::diffraction {

namespace {

template <typename T>
T fejer_ratio(T grooves, T delta) {
    constexpr T pi = std::numbers::pi_v<T>;
    const T period_delta = delta - std::round(delta);
    const T phase = grooves * period_delta;
    // Series about the peak: sin(Nx)/(N sin x) = 1 − (N²−1)x²/6 + O((Nx)⁴); below 1e-4 the remainder is below 1e-16.
    if (std::abs(phase) < T(1e-4)) {
        const T x = pi * period_delta;
        const T ratio = T(1) - (grooves - T(1)) * (grooves + T(1)) * x * x / T(6);
        return ratio * ratio;
    }
    // N·δ modulo 1 before the sine; the product's rounding error is added again.
    const T rounding = std::fma(grooves, period_delta, -phase);
    const T folded = (phase - std::round(phase)) + rounding;
    const T ratio = std::sin(pi * folded) / (grooves * std::sin(pi * period_delta));
    return ratio * ratio;
}

}  // namespace

double fejer(double grooves, double delta) {
    return fejer_ratio(grooves, delta);
}
float fejer(float grooves, float delta) {
    return fejer_ratio(grooves, delta);
}

}  // namespace rowland::diffraction
