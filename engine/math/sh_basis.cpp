#include "engine/math/sh_basis.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "engine/core/check.h"

namespace rowland::math {

namespace {

constexpr auto kBands = static_cast<std::size_t>(kMaximumBands);

/// Factors of the recurrences of the normalised associated Legendre functions divided by sin^m θ,
/// P_m,m = diagonal[m],  P_l,m = a[m][l] z P_l−1,m − b[m][l] P_l−2,m  [Press et al., Numerical Recipes, 3rd ed., §6.7].
/// m ≠ 0 has the √2 of the real basis.
struct Recurrence {
    std::array<double, kBands> diagonal{};
    std::array<std::array<double, kBands>, kBands> a{};
    std::array<std::array<double, kBands>, kBands> b{};

    Recurrence();
};

Recurrence::Recurrence() {
    double squared = 1 / (4 * std::numbers::pi);
    diagonal[0] = std::sqrt(squared);
    for (std::size_t m = 1; m < kBands; ++m) {
        const auto k = static_cast<double>(m);
        squared *= (2 * k + 1) / (2 * k);
        diagonal[m] = std::sqrt(2 * squared);
    }
    for (std::size_t m = 0; m < kBands; ++m)
        for (std::size_t l = m + 1; l < kBands; ++l) {
            const auto x = static_cast<double>(l);
            const auto k = static_cast<double>(m);
            a[m][l] = std::sqrt((4 * x * x - 1) / (x * x - k * k));
            b[m][l] = std::sqrt((2 * x + 1) * ((x - 1) * (x - 1) - k * k) / ((2 * x - 3) * (x * x - k * k)));
        }
}

}  // namespace

void evaluate_sh(const glm::dvec3& direction, int bands, std::span<double> values) {
    ROWLAND_CHECK_OP(bands, >=, 1);
    ROWLAND_CHECK_OP(bands, <=, kMaximumBands);
    ROWLAND_CHECK_OP(values.size(), >=, static_cast<std::size_t>(sh_count(bands)));
    static const Recurrence factors;
    const double z = direction.z;
    // sin^m θ cos mφ and sin^m θ sin mφ as polynomials in x and y: no angle, no pole.
    double cosine = 1;
    double sine = 0;
    for (int m = 0; m < bands; ++m) {
        const auto k = static_cast<std::size_t>(m);
        double before = 0;
        double legendre = factors.diagonal[k];
        for (int l = m; l < bands; ++l) {
            if (l > m) {
                const auto i = static_cast<std::size_t>(l);
                const double next = factors.a[k][i] * z * legendre - factors.b[k][i] * before;
                before = legendre;
                legendre = next;
            }
            values[static_cast<std::size_t>(sh_index(l, m))] = legendre * cosine;
            if (m > 0) values[static_cast<std::size_t>(sh_index(l, -m))] = legendre * sine;
        }
        const double turned = direction.x * cosine - direction.y * sine;
        sine = direction.x * sine + direction.y * cosine;
        cosine = turned;
    }
}

}  // namespace rowland::math
