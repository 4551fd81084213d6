#pragma once

#include <cstddef>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#define ROWLAND_INLINE inline __attribute__((always_inline))

// A vector of floats as wide as the translation unit is compiled for. Everything here has internal linkage, see
// kernels.h.
namespace rowland::math::simd {
namespace {
// NOLINTBEGIN(misc-definitions-in-headers): one for each instruction set, see kernels.h

#if defined(__AVX2__)
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif

using Vec = float __attribute__((vector_size(kLanes * sizeof(float))));

ROWLAND_INLINE Vec load(const float* p) {
    Vec v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
}

ROWLAND_INLINE void store(float* p, Vec v) {
    __builtin_memcpy(p, &v, sizeof v);
}

ROWLAND_INLINE Vec broadcast(float x) {
    return x - Vec{};
}

ROWLAND_INLINE Vec square_root(Vec v) {
#if defined(__AVX2__)
    return _mm256_sqrt_ps(v);
#elif defined(__SSE2__)
    return _mm_sqrt_ps(v);
#else
    for (int i = 0; i < kLanes; ++i) v[i] = __builtin_sqrtf(v[i]);
    return v;
#endif
}

/// Stores kLanes rows as columns: out[lane · stride + row] = rows[row][lane].
ROWLAND_INLINE void store_transposed(const Vec* rows, float* out, std::size_t stride) {
#if defined(__AVX2__)
    Vec pairs[8];
    for (int i = 0; i < 8; i += 2) {
        pairs[i] = __builtin_shufflevector(rows[i], rows[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
        pairs[i + 1] = __builtin_shufflevector(rows[i], rows[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
    }
    Vec fours[8];  // lanes k and k + 4 of rows 0 … 3 (or 4 … 7)
    for (int i = 0; i < 8; i += 4)
        for (int j = 0; j < 2; ++j) {
            fours[i + 2 * j] = __builtin_shufflevector(pairs[i + j], pairs[i + j + 2], 0, 1, 8, 9, 4, 5, 12, 13);
            fours[i + 2 * j + 1] = __builtin_shufflevector(pairs[i + j], pairs[i + j + 2], 2, 3, 10, 11, 6, 7, 14, 15);
        }
    for (std::size_t k = 0; k < 4; ++k) {
        store(out + k * stride, __builtin_shufflevector(fours[k], fours[k + 4], 0, 1, 2, 3, 8, 9, 10, 11));
        store(out + (k + 4) * stride, __builtin_shufflevector(fours[k], fours[k + 4], 4, 5, 6, 7, 12, 13, 14, 15));
    }
#else
    Vec pairs[4];
    for (int i = 0; i < 4; i += 2) {
        pairs[i] = __builtin_shufflevector(rows[i], rows[i + 1], 0, 4, 1, 5);
        pairs[i + 1] = __builtin_shufflevector(rows[i], rows[i + 1], 2, 6, 3, 7);
    }
    for (std::size_t j = 0; j < 2; ++j) {
        store(out + 2 * j * stride, __builtin_shufflevector(pairs[j], pairs[j + 2], 0, 1, 4, 5));
        store(out + (2 * j + 1) * stride, __builtin_shufflevector(pairs[j], pairs[j + 2], 2, 3, 6, 7));
    }
#endif
}

/// Stores `count` rows lane by lane: out[lane · count + row] = rows[row][lane].
ROWLAND_INLINE void store_interleaved(const Vec* rows, int count, float* out) {
    const auto stride = static_cast<std::size_t>(count);
    if (count < kLanes) {
        for (int lane = 0; lane < kLanes; ++lane)
            for (int row = 0; row < count; ++row) *out++ = rows[row][lane];
        return;
    }
    for (int row = 0; row + kLanes <= count; row += kLanes) store_transposed(rows + row, out + row, stride);
    // The last rows again, from the end: writing some twice costs less than writing them one by one.
    if (count % kLanes != 0) store_transposed(rows + count - kLanes, out + count - kLanes, stride);
}

template <int I>
struct Index {
    static constexpr int value = I;
};

/// f(Index<Begin>), …, f(Index<End − 1>), written out.
template <int Begin, int End, typename F>
ROWLAND_INLINE void unroll(const F& f) {
    if constexpr (Begin < End) {
        f(Index<Begin>{});
        unroll<Begin + 1, End>(f);
    }
}

// NOLINTEND(misc-definitions-in-headers)
}  // namespace
}  // namespace rowland::math::simd
