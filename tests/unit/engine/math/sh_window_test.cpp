#include "engine/math/sh_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace rowland::math {
namespace {

constexpr int kBands = 5;

/// Windowed point light of five bands at the angle whose cosine is z: Σ w_l (2l+1)/4π P_l(z).
double point_light(SphericalWindow window, double z) {
    double sum = 0;
    for (int l = 0; l < kBands; ++l)
        sum += window_factor(window, l, kBands) * (2 * l + 1) / (4 * std::numbers::pi) *
               std::legendre(static_cast<unsigned>(l), z);
    return sum;
}

TEST(ShWindow, TradesPeakForUndershootAsMeasured) {
    // PHYSICS §7 prints these with two and three digits.
    const double peak[] = {1.99, 1.05, 0.82};
    const double undershoot[] = {-0.152, -0.056, -0.038};
    int i = 0;
    for (const auto window : {SphericalWindow::None, SphericalWindow::Lanczos, SphericalWindow::Hann}) {
        const double top = point_light(window, 1);
        double lowest = top;
        for (int k = 0; k <= 20000; ++k) lowest = std::min(lowest, point_light(window, k / 10000.0 - 1));
        EXPECT_NEAR(top, peak[i], 0.005) << window_name(window);
        EXPECT_NEAR(lowest / top, undershoot[i], 0.0005) << window_name(window);
        ++i;
    }
}

TEST(ShWindow, KeepsBandZeroAndFallsMonotonically) {
    for (const auto window : {SphericalWindow::None, SphericalWindow::Lanczos, SphericalWindow::Hann}) {
        EXPECT_EQ(window_factor(window, 0, 8), 1);
        for (int l = 1; l < 8; ++l) {
            EXPECT_LE(window_factor(window, l, 8), window_factor(window, l - 1, 8));
            EXPECT_GT(window_factor(window, l, 8), 0);
        }
    }
}

TEST(ShWindow, ExponentialDampsByEigenvalueOfTheLaplacian) {
    EXPECT_EQ(exponential_window_factor(0.3, 0), 1);
    EXPECT_NEAR(exponential_window_factor(0.3, 2), std::exp(-1.8), 1e-15);
    EXPECT_EQ(exponential_window_factor(0, 7), 1);
}

}  // namespace
}  // namespace rowland::math
