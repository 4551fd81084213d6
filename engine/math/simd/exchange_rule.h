#pragma once

namespace rowland::math::simd {
namespace {

/// The columns of the non-zero entries of row (l, m) in the matrix J that exchanges y and z: sign·k for k = first,
/// first + 2, … ≤ l. Y_lm is even or odd in x, y and z; J keeps the parity in x and turns that in y into that in z,
/// which leaves a quarter of each band [Pinchon & Hoggan 2007, "Rotation matrices for real spherical harmonics"].
struct ExchangeColumns {
    int first;
    int sign;
};

inline constexpr ExchangeColumns exchange_columns(int l, int m) {
    const int size = m < 0 ? -m : m;
    const bool even_in_x = (m >= 0) == (size % 2 == 0);
    const int parity = (l + (m < 0 ? 1 : 0)) % 2;  // of |column|: even in z if and only if the row is even in y
    const int sign = even_in_x == (parity == 0) ? 1 : -1;
    return {parity == 0 && sign < 0 ? 2 : parity, sign};
}

}  // namespace
}  // namespace rowland::math::simd
