#pragma once

#include <vector>

namespace rowland::math {

struct QuadratureRule {
    std::vector<double> nodes;  ///< ascending
    std::vector<double> weights;
};

/// Gauss–Legendre rule of `count` ≥ 1 nodes on [a, b], by Newton iteration on the Legendre polynomial. Error 1e-15.
QuadratureRule gauss_legendre(int count, double a, double b);

}  // namespace rowland::math
