#pragma once

#include "engine/math/simd/exchange_rule.h"
#include "engine/math/simd/kernels.h"
#include "engine/math/simd/lanes.h"

namespace rowland::math::simd {
namespace {
// NOLINTBEGIN(misc-definitions-in-headers): one for each instruction set, see kernels.h

constexpr int kChannels = 3;

/// Bands for which the loops are written out, 0: none. An instrumented build would take minutes to compile.
#ifdef ROWLAND_MATH_KEEP_LOOPS
constexpr int kWrittenOutBands = 0;
#else
constexpr int kWrittenOutBands = 5;
#endif

constexpr int kMostBands = 16;
constexpr int kMostRows = kMostBands * kMostBands * kChannels;

/// cos mθ and sin mθ of one turn, m = 0 … bands − 1.
struct Turn {
    Vec cosine[kMostBands];
    Vec sine[kMostBands];
};

/// By halving m, so that rounding grows with log m.
ROWLAND_INLINE void fill_turn(Vec cosine, Vec sine, int bands, Turn& turn) {
    turn.cosine[0] = broadcast(1);
    turn.sine[0] = Vec{};
    turn.cosine[1] = cosine;
    turn.sine[1] = sine;
    for (int m = 2; m < bands; ++m) {
        const int a = m / 2;
        const int b = m - a;
        turn.cosine[m] = turn.cosine[a] * turn.cosine[b] - turn.sine[a] * turn.sine[b];
        turn.sine[m] = turn.sine[a] * turn.cosine[b] + turn.cosine[a] * turn.sine[b];
    }
}

/// Azimuth and inclination of n, and the azimuth of g once n is turned onto the z axis.
struct Turns {
    Turn azimuth;
    Turn inclination;
    Turn last;
};

/// The unit vector along (x, y), or (1, 0) where that is nothing beside `scale`, the square of a length. Returns the
/// length of (x, y), then 0.
ROWLAND_INLINE Vec direction(Vec x, Vec y, Vec scale, Vec& cosine, Vec& sine) {
    const Vec squared = x * x + y * y;
    const auto usable = squared > 1e-24F * scale;
    const Vec length = square_root(squared);
    const Vec inverse = 1.0F / (usable ? length : broadcast(1));
    cosine = usable ? x * inverse : broadcast(1);
    sine = usable ? y * inverse : Vec{};
    return usable ? length : Vec{};
}

ROWLAND_INLINE void find_turns(const Vec (&g)[3], const Vec (&n)[3], int bands, Turns& turns) {
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
    fill_turn(cos_azimuth, sin_azimuth, bands, turns.azimuth);
    fill_turn(cos_inclination, sin_inclination, bands, turns.inclination);
    fill_turn(cos_last, sin_last, bands, turns.last);
}

/// Calls f(l, m) for all m of all bands (or all m ≥ 0), with the loops written out if Bands > 0.
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

/// Light turned about z by −θ, for light that is the same in all lanes (`in` are floats) or not (vectors).
template <int Bands, typename In>
ROWLAND_INLINE void turn_about_z(const In* in, const Turn& turn, float sign, int bands, Vec* out) {
    for_each_coefficient<Bands>(
        bands, [&](int l, int m) __attribute__((always_inline)) {
            if (m < 0) return;
            const int even = kChannels * (l * (l + 1) + m);
            const int odd = kChannels * (l * (l + 1) - m);
            if (m == 0) {
                for (int c = 0; c < kChannels; ++c) out[even + c] = in[even + c] + Vec{};
                return;
            }
            const Vec cosine = turn.cosine[m];
            const Vec sine = sign * turn.sine[m];
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

/// The light in kLanes frames, 3 bands² vectors, RGB innermost.
template <int Bands>
ROWLAND_INLINE void rotate_lanes(const Light& light, const Vec (&g)[3], const Vec (&n)[3], Vec* rotated) {
    Turns turns;
    const int bands = Bands > 0 ? Bands : light.bands;
    find_turns(g, n, bands, turns);
    Vec turned[kMostRows];
    turn_about_z<Bands>(light.coefficients, turns.azimuth, 1, bands, rotated);
    exchange_y_and_z<Bands>(rotated, light.exchange, bands, turned);
    turn_about_z<Bands>(turned, turns.inclination, -1, bands, rotated);
    exchange_y_and_z<Bands>(rotated, light.exchange, bands, turned);
    turn_about_z<Bands>(turned, turns.last, 1, bands, rotated);
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
    if (light.bands == kWrittenOutBands)
        rotate_all<kWrittenOutBands>(light, frames, finish, out);
    else
        rotate_all<0>(light, frames, finish, out);
}

/// The frames that do not fill the lanes go through a padded copy; `scratch` holds kLanes results.
template <typename Finish>
void rotate_frames(const Light& light, const Frames& frames, const Finish& finish, float* scratch, float* out) {
    rotate_whole_lanes(light, frames, finish, out);
    const std::size_t rest = frames.count % kLanes;
    if (rest == 0) return;
    const std::size_t done = frames.count - rest;
    float padded[6][kLanes] = {};
    Frames last{{padded[0], padded[1], padded[2]}, {padded[3], padded[4], padded[5]}, kLanes};
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t lane = 0; lane < rest; ++lane) {
            padded[axis][lane] = frames.tangent[axis][done + lane];
            padded[axis + 3][lane] = frames.normal[axis][done + lane];
        }
    rotate_whole_lanes(light, last, finish, scratch);
    const auto count = static_cast<std::size_t>(finish.count());
    __builtin_memcpy(out + done * count, scratch, rest * count * sizeof(float));
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
