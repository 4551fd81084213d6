#pragma once

#include <cstddef>
#include <cstdint>

namespace rowland::math::simd {

// What the fast paths compute, as plain pointers: the translation units compiled for a wider instruction set must not
// instantiate anything of external linkage, or the linker could pick their copy for everyone.

/// Factors of the recurrences of sh_basis.cpp: P_m,m = diagonal[m], P_l,m = a[l² + m] z P_l−1,m − b[l² + m] P_l−2,m.
struct Recurrence {
    float diagonal[16];
    float a[256];
    float b[256];
};

struct Directions {
    const float* x;
    const float* y;
    const float* z;
    std::size_t count;
};

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
    void (*evaluate)(const Directions&, int bands, const Recurrence&, std::size_t stride, float* values);
    void (*rotate)(const Light&, const Frames&, float* out);
    void (*project)(const Light&, const Frames&, const SparseMatrix&, float* out);
};

Kernels baseline_kernels();
#ifdef ROWLAND_MATH_AVX2
Kernels avx2_kernels();
#endif

}  // namespace rowland::math::simd
