#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "engine/math/instruction_set.h"

namespace rowland::math {

/// Bands up to which the single-precision paths go.
inline constexpr int kMaximumFastBands = 16;

/// evaluate_sh() in single precision for many directions: writes function i at direction k to values[i·stride + k].
/// `direction` holds the components x, y, z of unit vectors, equally many of each; 1 ≤ bands ≤ 16; stride ≥ that many;
/// values.size() ≥ (bands² − 1)·stride + that many. Error ≤ 1e-6 up to 5 bands, ≤ 4e-6 up to 16 (values reach
/// √((2 bands − 1)/4π)). Straight-line code for five bands [after Sloan 2013, "Efficient spherical harmonic
/// evaluation"], loops over the recurrences for others. Runs on the calling thread. A stride that is a multiple of 4
/// KiB makes the rows evict each other from the first cache.
void evaluate_sh_batch(const std::array<std::span<const float>, 3>& direction, int bands, std::size_t stride,
                       std::span<float> values, InstructionSet set = best_instruction_set());

}  // namespace rowland::math
