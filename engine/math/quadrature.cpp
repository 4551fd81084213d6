#include "engine/math/quadrature.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "engine/core/check.h"

namespace rowland::math {

namespace {

struct Legendre {
    double value = 0;
    double derivative = 0;
};

/// P_n and P_n' at x in (−1, 1).
Legendre legendre(int n, double x) {
    double before = 1;
    double now = x;
    for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
        before = now;
        now = next;
    }
    return {now, n * (x * now - before) / (x * x - 1)};
}

}  // namespace

QuadratureRule gauss_legendre(int count, double a, double b) {
    ROWLAND_CHECK_OP(count, >=, 1);
    const auto size = static_cast<std::size_t>(count);
    QuadratureRule rule{std::vector<double>(size), std::vector<double>(size)};
    const double middle = (a + b) / 2;
    const double half = (b - a) / 2;
    for (std::size_t i = 0; i < (size + 1) / 2; ++i) {
        // Root i from the right. The guess is good to O(count^-4), so Newton doubles its digits from the start.
        const bool central = 2 * i + 1 == size;
        double x = central ? 0.0 : std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (count + 0.5));
        for (int step = 0; step < 8 && !central; ++step) {
            const Legendre p = legendre(count, x);
            const double change = p.value / p.derivative;
            x -= change;
            if (std::abs(change) < 1e-16) break;
        }
        const double slope = count == 1 ? 1.0 : legendre(count, x).derivative;
        const double weight = half * 2 / ((1 - x * x) * slope * slope);
        rule.nodes[i] = middle - half * x;
        rule.nodes[size - 1 - i] = middle + half * x;
        rule.weights[i] = weight;
        rule.weights[size - 1 - i] = weight;
    }
    return rule;
}

}  // namespace rowland::math
