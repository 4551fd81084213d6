#pragma once

#include "engine/math/instruction_set.h"
#include "engine/math/simd/kernels.h"

namespace rowland::math::simd {

/// The kernels compiled for a set, which must be supported.
Kernels kernels(InstructionSet set);

}  // namespace rowland::math::simd
