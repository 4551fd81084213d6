#include "engine/math/simd/evaluate_kernel.h"
#include "engine/math/simd/rotate_kernel.h"

namespace rowland::math::simd {

Kernels baseline_kernels() {
    return {evaluate, rotate, project};
}

}  // namespace rowland::math::simd
