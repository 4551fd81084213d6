#pragma once

#include <cstddef>
#include <cstdint>

namespace rowland::math::simd {

// Arguments of the fast paths, as plain pointers: translation units compiled for a wider instruction set must not
// instantiate anything of external linkage, or the linker could use that copy everywhere.

struct Light {
    const float* coefficients;  ///< bands² × 3, RGB innermost
    int bands;
    const float* exchange;  ///< non-zero entries of ±J, which exchanges y and z, row after row; see exchange_rule.h
};

struct Frames {
    const float* tangent[3];
    const float* normal[3];
    std::size_t count;
};

struct SparseMatrix {
    int rows;
    const std::int32_t* first;   ///< rows + 1
    const std::int32_t* column;  ///< of each entry
    const float* weight;         ///< of each entry
};

struct Kernels {
    void (*rotate)(const Light&, const Frames&, float* out);
    void (*project)(const Light&, const Frames&, const SparseMatrix&, float* out);
};

Kernels baseline_kernels();
#ifdef ROWLAND_MATH_AVX2
Kernels avx2_kernels();
#endif

}  // namespace rowland::math::simd
