#include "engine/math/simd/dispatch.h"

#include "engine/core/check.h"

namespace rowland::math::simd {

Kernels kernels(InstructionSet set) {
    ROWLAND_CHECK(is_supported(set), "this processor or this build lacks the instruction set asked for");
#ifdef ROWLAND_MATH_AVX2
    if (set == InstructionSet::Avx2) return avx2_kernels();
#endif
    return baseline_kernels();
}

}  // namespace rowland::math::simd
