#pragma once

#include <cmath>

namespace rowland::colour {

// sRGB's curve between a linear component and its encoded value, both in [0, 1]: IEC 61966-2-1.

inline double srgb_encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

inline double srgb_linear(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace rowland::colour
