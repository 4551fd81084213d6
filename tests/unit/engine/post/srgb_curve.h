#pragma once

#include <cmath>

namespace rowland::test {

/// The curve of IEC 61966-2-1, of values from 0 to 1.
inline double srgb_of_linear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

inline double linear_of_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace rowland::test
