#pragma once

#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rowland::lighting {

// Light in files: numbers ≥ 0 as half floats times a power of two, which loses nothing.

/// The power of two by which `largest` ≥ 0 lands in [16384, 32768): as far from underflow as possible without overflow.
inline float half_scale(double largest) {
    return largest > 0 ? std::ldexp(1.0F, std::max(std::ilogb(largest) + 1 - 15, -120)) : 1.0F;
}

inline std::uint16_t to_half(double value, float scale) {
    return half(static_cast<float>(value / static_cast<double>(scale))).bits();
}

inline float from_half(std::uint16_t bits) {
    half value;
    value.setBits(bits);
    return value;
}

/// Half floats from here on are infinite, NaN or negative.
inline constexpr std::uint16_t kFirstHalfNotLight = 0x7c00;

}  // namespace rowland::lighting
