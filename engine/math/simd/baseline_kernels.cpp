#include "engine/math/simd/rotate_kernel.h"

namespace rowland::math::simd {

Kernels baseline_kernels() {
    return {rotate, project};
}

}  // namespace rowland::math::simd
