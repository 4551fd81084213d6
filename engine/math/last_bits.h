#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace rowland::math {

/// Rounds numbers to multiples of 2^−bits of a power of two above the largest magnitude. C libraries differ in the last
/// bits of their functions, and sums that are 0 in exact arithmetic consist of such bits: without them cooked files
/// have the same bytes on all systems, but for numbers that lie at the middle between two multiples.
inline void drop_last_bits(std::span<double> values, int bits = 44) {
    double largest = 0.0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    int exponent = 0;
    std::frexp(largest, &exponent);
    for (double& value : values)
        value = std::ldexp(std::round(std::ldexp(value, bits - exponent)), exponent - bits) + 0.0;  // no -0
}

}  // namespace rowland::math
