#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#define ROWLAND_INLINE inline __attribute__((always_inline))

// The kernels of frame_rotation.h. Each instruction set compiles this header once, so everything here has internal
// linkage and arguments are plain pointers: a translation unit compiled for a wider set must not instantiate anything
// of external linkage, or the linker could use that copy everywhere.
namespace rowland::math::simd {

struct Light {
    const float* coefficients;  ///< bands² × 3, RGB innermost
    int bands;
    const float* exchange;  ///< non-zero entries of ±J, which exchanges y and z, row after row; see exchange_columns()
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

#ifdef ROWLAND_MATH_AVX2
Kernels avx2_kernels();
#endif

namespace {

// NOLINTBEGIN(misc-definitions-in-headers): one for each instruction set

/// The columns of the non-zero entries of row (l, m) in the matrix J that exchanges y and z: sign·k for k = first,
/// first + 2, … ≤ l. Y_lm is even or odd in x, y and z; J keeps the parity in x and exchanges those in y and z,
/// which leaves a quarter of each band [Pinchon & Hoggan 2007, "Rotation matrices for real spherical harmonics"].
struct ExchangeColumns {
    int first;
    int sign;
};

inline constexpr ExchangeColumns exchange_columns(int l, int m) {
    const int size = m < 0 ? -m : m;
    const bool even_in_x = (m >= 0) == (size % 2 == 0);
    const int parity = (l + (m < 0 ? 1 : 0)) % 2;  // of |column|: even in z if and only if the row is even in y
    const int sign = even_in_x == (parity == 0) ? 1 : -1;
    return {parity == 0 && sign < 0 ? 2 : parity, sign};
}

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

/// Calls f(Index<Begin>), …, f(Index<End − 1>) without a loop.
template <int Begin, int End, typename F>
ROWLAND_INLINE void unroll(const F& f) {
    if constexpr (Begin < End) {
        f(Index<Begin>{});
        unroll<Begin + 1, End>(f);
    }
}

constexpr int kChannels = 3;

/// The number of bands for which loops are unrolled. 0: none, for instrumented builds, which would take minutes to
/// compile.
#ifdef ROWLAND_MATH_KEEP_LOOPS
constexpr int kUnrolledBands = 0;
#else
constexpr int kUnrolledBands = 5;
#endif

constexpr int kMostBands = 16;
constexpr int kMostRows = kMostBands * kMostBands * kChannels;

/// cos mθ and sin mθ of an angle θ, m = 0 … bands − 1.
struct AngleMultiples {
    Vec cosine[kMostBands];
    Vec sine[kMostBands];
};

/// Fills `angle` from cos θ and sin θ. Multiple m is the sum of two halves, so that rounding grows with log m.
ROWLAND_INLINE void fill_multiples(Vec cosine, Vec sine, int bands, AngleMultiples& angle) {
    angle.cosine[0] = broadcast(1);
    angle.sine[0] = Vec{};
    angle.cosine[1] = cosine;
    angle.sine[1] = sine;
    for (int m = 2; m < bands; ++m) {
        const int a = m / 2;
        const int b = m - a;
        angle.cosine[m] = angle.cosine[a] * angle.cosine[b] - angle.sine[a] * angle.sine[b];
        angle.sine[m] = angle.sine[a] * angle.cosine[b] + angle.cosine[a] * angle.sine[b];
    }
}

/// Azimuth and inclination of n, and the azimuth of g after the rotation of n onto the z axis.
struct FrameAngles {
    AngleMultiples azimuth;
    AngleMultiples inclination;
    AngleMultiples last;
};

/// The unit vector (cosine, sine) along (x, y), and as the result the length of (x, y). (1, 0) and 0 where that length
/// is below 1e-12 √scale.
ROWLAND_INLINE Vec direction(Vec x, Vec y, Vec scale, Vec& cosine, Vec& sine) {
    const Vec squared = x * x + y * y;
    const auto usable = squared > 1e-24F * scale;
    const Vec length = square_root(squared);
    const Vec inverse = 1.0F / (usable ? length : broadcast(1));
    cosine = usable ? x * inverse : broadcast(1);
    sine = usable ? y * inverse : Vec{};
    return usable ? length : Vec{};
}

ROWLAND_INLINE void find_angles(const Vec (&g)[3], const Vec (&n)[3], int bands, FrameAngles& angles) {
    Vec cos_azimuth;
    Vec sin_azimuth;
    const Vec scale = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    const Vec across = direction(n[0], n[1], scale, cos_azimuth, sin_azimuth);
    Vec cos_inclination;
    Vec sin_inclination;
    direction(n[2], across, scale, cos_inclination, sin_inclination);
    const Vec toward = cos_azimuth * g[0] + sin_azimuth * g[1];
    const Vec g_x = cos_inclination * toward - sin_inclination * g[2];
    const Vec g_y = cos_azimuth * g[1] - sin_azimuth * g[0];
    Vec cos_last;
    Vec sin_last;
    direction(g_x, g_y, g[0] * g[0] + g[1] * g[1] + g[2] * g[2], cos_last, sin_last);
    fill_multiples(cos_azimuth, sin_azimuth, bands, angles.azimuth);
    fill_multiples(cos_inclination, sin_inclination, bands, angles.inclination);
    fill_multiples(cos_last, sin_last, bands, angles.last);
}

/// Calls f(l, m) for all m of all bands, with unrolled loops if Bands > 0.
template <int Bands, typename F>
ROWLAND_INLINE void for_each_coefficient(int bands, const F& f) {
    if constexpr (Bands > 0)
        unroll<0, Bands>([&](auto band) __attribute__((always_inline)) {
            constexpr int l = decltype(band)::value;
            unroll<-l, l + 1>([&](auto order) __attribute__((always_inline)) { f(l, decltype(order)::value); });
        });
    else
        for (int l = 0; l < bands; ++l)
            for (int m = -l; m <= l; ++m) f(l, m);
}

/// Light rotated about z by −sign · θ. `in`: floats for light that is the same in all lanes, else vectors.
template <int Bands, typename In>
ROWLAND_INLINE void rotate_about_z(const In* in, const AngleMultiples& angle, float sign, int bands, Vec* out) {
    for_each_coefficient<Bands>(
        bands, [&](int l, int m) __attribute__((always_inline)) {
            if (m < 0) return;
            const int even = kChannels * (l * (l + 1) + m);
            const int odd = kChannels * (l * (l + 1) - m);
            if (m == 0) {
                for (int c = 0; c < kChannels; ++c) out[even + c] = in[even + c] + Vec{};
                return;
            }
            const Vec cosine = angle.cosine[m];
            const Vec sine = sign * angle.sine[m];
            for (int c = 0; c < kChannels; ++c) {
                const auto a = in[even + c];
                const auto b = in[odd + c];
                out[even + c] = a * cosine + b * sine;
                out[odd + c] = b * cosine - a * sine;
            }
        });
}

template <int Bands>
ROWLAND_INLINE void exchange_y_and_z(const Vec* in, const float* weight, int bands, Vec* out) {
    for_each_coefficient<Bands>(
        bands, [&](int l, int m) __attribute__((always_inline)) {
            const ExchangeColumns columns = exchange_columns(l, m);
            Vec sum[kChannels] = {};
            for (int k = columns.first; k <= l; k += 2) {
                const float w = *weight++;
                const Vec* source = in + std::ptrdiff_t{kChannels} * (l * (l + 1) + columns.sign * k);
                for (int c = 0; c < kChannels; ++c) sum[c] += w * source[c];
            }
            Vec* target = out + std::ptrdiff_t{kChannels} * (l * (l + 1) + m);
            for (int c = 0; c < kChannels; ++c) target[c] = sum[c];
        });
}

/// The light in kLanes frames: `rotated` receives 3 bands² vectors, RGB innermost.
template <int Bands>
ROWLAND_INLINE void rotate_lanes(const Light& light, const Vec (&g)[3], const Vec (&n)[3], Vec* rotated) {
    FrameAngles angles;
    const int bands = Bands > 0 ? Bands : light.bands;
    find_angles(g, n, bands, angles);
    Vec exchanged[kMostRows];
    rotate_about_z<Bands>(light.coefficients, angles.azimuth, 1, bands, rotated);
    exchange_y_and_z<Bands>(rotated, light.exchange, bands, exchanged);
    rotate_about_z<Bands>(exchanged, angles.inclination, -1, bands, rotated);
    exchange_y_and_z<Bands>(rotated, light.exchange, bands, exchanged);
    rotate_about_z<Bands>(exchanged, angles.last, 1, bands, rotated);
}

/// How rotated light is written: unchanged, or multiplied by a sparse matrix.
struct Keep {
    int rows;
    int count() const { return rows; }
    ROWLAND_INLINE void operator()(const Vec* rotated, float* out) const { store_interleaved(rotated, rows, out); }
};

struct Project {
    const SparseMatrix& matrix;
    Vec* moments;  ///< rows · 3
    int count() const { return kChannels * matrix.rows; }
    ROWLAND_INLINE void operator()(const Vec* rotated, float* out) const {
        for (int row = 0; row < matrix.rows; ++row) {
            Vec sum[kChannels] = {};
            for (int i = matrix.first[row]; i < matrix.first[row + 1]; ++i) {
                const Vec* source = rotated + std::ptrdiff_t{kChannels} * matrix.column[i];
                for (int c = 0; c < kChannels; ++c) sum[c] += matrix.weight[i] * source[c];
            }
            for (int c = 0; c < kChannels; ++c) moments[kChannels * row + c] = sum[c];
        }
        store_interleaved(moments, count(), out);
    }
};

template <int Bands, typename Finish>
void rotate_all(const Light& light, const Frames& frames, const Finish& finish, float* out) {
    Vec rotated[kMostRows];
    const auto count = static_cast<std::size_t>(finish.count());
    Vec g[3];
    Vec n[3];
    std::size_t k = 0;
    for (; k + kLanes <= frames.count; k += kLanes) {
        for (int axis = 0; axis < 3; ++axis) {
            g[axis] = load(frames.tangent[axis] + k);
            n[axis] = load(frames.normal[axis] + k);
        }
        rotate_lanes<Bands>(light, g, n, rotated);
        finish(rotated, out + k * count);
    }
}

template <typename Finish>
void rotate_whole_lanes(const Light& light, const Frames& frames, const Finish& finish, float* out) {
    if (light.bands == kUnrolledBands)
        rotate_all<kUnrolledBands>(light, frames, finish, out);
    else
        rotate_all<0>(light, frames, finish, out);
}

/// The frames that do not fill the lanes go through a padded copy; `scratch` holds kLanes results.
template <typename Finish>
void rotate_frames(const Light& light, const Frames& frames, const Finish& finish, float* scratch, float* out) {
    rotate_whole_lanes(light, frames, finish, out);
    const std::size_t remainder = frames.count % kLanes;
    if (remainder == 0) return;
    const std::size_t done = frames.count - remainder;
    float padded[6][kLanes] = {};
    Frames last{{padded[0], padded[1], padded[2]}, {padded[3], padded[4], padded[5]}, kLanes};
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t lane = 0; lane < remainder; ++lane) {
            padded[axis][lane] = frames.tangent[axis][done + lane];
            padded[axis + 3][lane] = frames.normal[axis][done + lane];
        }
    rotate_whole_lanes(light, last, finish, scratch);
    const auto count = static_cast<std::size_t>(finish.count());
    __builtin_memcpy(out + done * count, scratch, remainder * count * sizeof(float));
}

/// See rotate_to_frames().
void rotate(const Light& light, const Frames& frames, float* out) {
    float scratch[kMostRows * kLanes];
    rotate_frames(light, frames, Keep{kChannels * light.bands * light.bands}, scratch, out);
}

/// See rotate_and_project(); at most 256 rows.
void project(const Light& light, const Frames& frames, const SparseMatrix& matrix, float* out) {
    Vec moments[kMostRows];
    float scratch[kMostRows * kLanes];
    rotate_frames(light, frames, Project{matrix, moments}, scratch, out);
}

// NOLINTEND(misc-definitions-in-headers)

}  // namespace
}  // namespace rowland::math::simd
