// Compiled for AVX2 and FMA, see CMakeLists.txt: include nothing here that could be emitted outside this file.
#include "engine/math/frame_rotation_kernels.h"

namespace rowland::math::simd {

Kernels avx2_kernels() {
    return {rotate, project};
}

}  // namespace rowland::math::simd
