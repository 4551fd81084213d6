#include "engine/lighting/ambient.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <vector>

#include "engine/math/sh_basis.h"
#include "engine/math/sh_convolution.h"

namespace rowland::lighting {

namespace {

constexpr int kBands = 3;

double band_factor(const AmbientWindow& window, int l) {
    return window.damping > 0 ? math::exponential_window_factor(window.damping, l)
                              : math::window_factor(window.window, l, kBands);
}

AmbientLight convolve(const ShLight& light, const AmbientWindow& window) {
    AmbientLight ambient;
    ambient.window = window;
    for (int l = 0; l < std::min(kBands, light.bands); ++l) {
        const double factor = band_factor(window, l) * math::clamped_cosine_factor(l) / std::numbers::pi;
        for (int m = -l; m <= l; ++m) {
            const auto i = static_cast<std::size_t>(math::sh_index(l, m));
            ambient.coefficients[i] = factor * light.coefficients[i];
        }
    }
    return ambient;
}

/// A direction in which irradiance must not be negative: basis values, and E/π of the key lights.
struct Trial {
    std::array<double, 9> basis{};
    glm::dvec3 from_keys{0.0};
};

/// Directions spread over the sphere (a Fibonacci spiral). 4096 of them are 3° apart, where three bands vary by less
/// than .5 % of their amplitude around an extremum.
std::vector<Trial> spread_trials(std::span<const KeyLight> keys) {
    constexpr int kCount = 4096;
    std::vector<Trial> trials(kCount);
    for (int i = 0; i < kCount; ++i) {
        Trial& trial = trials[static_cast<std::size_t>(i)];
        const double z = 1 - (2 * i + 1.0) / kCount;
        const double phi = 2 * std::numbers::pi * std::fmod(i * std::numbers::phi, 1.0);
        const double r = std::sqrt(1 - z * z);
        const glm::dvec3 normal(r * std::cos(phi), r * std::sin(phi), z);
        math::evaluate_sh(normal, kBands, trial.basis);
        for (const KeyLight& key : keys) trial.from_keys += irradiance(key, normal) / std::numbers::pi;
    }
    return trials;
}

bool is_non_negative(const AmbientLight& ambient, const std::vector<Trial>& trials) {
    // E of a probe that is dark on one side reaches 0, up to rounding.
    const glm::dvec3 tolerance = -1e-12 * glm::abs(ambient.coefficients[0]);
    for (const Trial& trial : trials) {
        glm::dvec3 sum = trial.from_keys;
        for (std::size_t i = 0; i < trial.basis.size(); ++i) sum += trial.basis[i] * ambient.coefficients[i];
        for (int c = 0; c < 3; ++c)
            if (sum[c] < tolerance[c]) return false;
    }
    return true;
}

}  // namespace

AmbientLight ambient_coefficients(const ShLight& light, std::span<const KeyLight> keys) {
    const std::vector<Trial> trials = spread_trials(keys);
    for (const auto window :
         {math::SphericalWindow::None, math::SphericalWindow::Lanczos, math::SphericalWindow::Hann}) {
        AmbientLight ambient = convolve(light, {window, 0});
        if (is_non_negative(ambient, trials)) return ambient;
    }
    // Damping 4 multiplies band 1 by .0003: nothing can go negative any more.
    for (double damping = 0.25; damping < 4; damping *= 1.25) {
        AmbientLight ambient = convolve(light, {math::SphericalWindow::None, damping});
        if (is_non_negative(ambient, trials)) return ambient;
    }
    return convolve(light, {math::SphericalWindow::None, 64});
}

}  // namespace rowland::lighting
