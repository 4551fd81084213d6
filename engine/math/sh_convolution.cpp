#include "engine/math/sh_convolution.h"

#include <numbers>

#include "engine/core/check.h"

namespace rowland::math {

double clamped_cosine_factor(int l) {
    ROWLAND_CHECK_OP(l, >=, 0);
    if (l == 1) return 2 * std::numbers::pi / 3;
    if (l % 2 == 1) return 0;
    // 2π (−1)^(l/2−1) / ((l+2)(l−1)) · l! / (2^l (l/2)!²); the last factor is Π (2k−1)/(2k), k = 1 … l/2.
    double factor = 2 * std::numbers::pi / (static_cast<double>(l + 2) * static_cast<double>(l - 1));
    for (int k = 1; k <= l / 2; ++k) factor *= static_cast<double>(2 * k - 1) / static_cast<double>(2 * k);
    return (l / 2) % 2 == 0 ? -factor : factor;
}

}  // namespace rowland::math
