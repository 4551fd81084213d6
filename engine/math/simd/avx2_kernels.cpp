// Compiled for AVX2 and FMA, see CMakeLists.txt: include nothing here that could be emitted outside this file.
#include "engine/math/simd/rotate_kernel.h"

namespace rowland::math::simd {

Kernels avx2_kernels() {
    return {rotate, project};
}

}  // namespace rowland::math::simd
