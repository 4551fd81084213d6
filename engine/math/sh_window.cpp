#include "engine/math/sh_window.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "engine/core/check.h"

namespace rowland::math {

const char* window_name(SphericalWindow window) {
    constexpr std::array kNames = {"none", "lanczos", "hann"};
    return kNames.at(static_cast<std::size_t>(window));
}

SphericalWindow parse_window(std::string_view name) {
    for (const auto window : {SphericalWindow::None, SphericalWindow::Lanczos, SphericalWindow::Hann})
        if (name == window_name(window)) return window;
    ROWLAND_CHECK(false, "parse_window() of a name that is none");
    return SphericalWindow::None;
}

double window_factor(SphericalWindow window, int l, int bands) {
    ROWLAND_CHECK_OP(l, >=, 0);
    ROWLAND_CHECK_OP(l, <, bands);
    const double x = std::numbers::pi * l / bands;
    switch (window) {
        case SphericalWindow::None:
            return 1;
        case SphericalWindow::Lanczos:
            return l == 0 ? 1 : std::sin(x) / x;
        case SphericalWindow::Hann:
            return (1 + std::cos(x)) / 2;
    }
    ROWLAND_CHECK(false, "unknown window");
    return 0;
}

double exponential_window_factor(double damping, int l) {
    ROWLAND_CHECK_OP(damping, >=, 0.0);
    ROWLAND_CHECK_OP(l, >=, 0);
    return std::exp(-damping * l * (l + 1));
}

}  // namespace rowland::math
