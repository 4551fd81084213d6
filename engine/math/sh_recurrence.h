#pragma once

#include <array>
#include <cstddef>

#include "engine/math/sh_basis.h"

namespace rowland::math {

/// Factors of the recurrences of the normalised associated Legendre functions divided by sin^m θ,
/// P_m,m = diagonal[m],  P_l,m = a[m][l] z P_l−1,m − b[m][l] P_l−2,m  [Press et al., Numerical Recipes, 3rd ed., §6.7].
/// m ≠ 0 carries the √2 of the real basis.
struct ShRecurrence {
    std::array<double, kMaximumBands> diagonal{};
    std::array<std::array<double, kMaximumBands>, kMaximumBands> a{};
    std::array<std::array<double, kMaximumBands>, kMaximumBands> b{};

    ShRecurrence();
};

/// The factors, computed once.
const ShRecurrence& sh_recurrence();

}  // namespace rowland::math
