#pragma once

#include "engine/math/simd/kernels.h"
#include "engine/math/simd/lanes.h"

namespace rowland::math::simd {
namespace {
// NOLINTBEGIN(misc-definitions-in-headers): one for each instruction set, see kernels.h

/// The 25 functions of five bands, as polynomials [Sloan 2013, "Efficient spherical harmonic evaluation", here without
/// the Condon–Shortley phase]. put(i, value) takes each.
template <typename Put>
ROWLAND_INLINE void evaluate_five_bands(Vec x, Vec y, Vec z, const Put& put) {
    const Vec zz = z * z;
    const Vec second = 0.94617469575756F * zz - 0.31539156525252F;
    const Vec third = z * (1.8658816629505769F * zz - 1.1195289977703462F);
    put(0, broadcast(0.28209479177387814F));
    put(2, 0.4886025119029199F * z);
    put(6, second);
    put(12, third);
    put(20, 1.9843134832984430F * z * third - 1.0062305898749054F * second);

    const Vec first1 = 1.0925484305920792F * z;
    const Vec second1 = 2.2852289973223289F * zz - 0.4570457994644658F;
    const Vec third1 = z * (4.6833258049010240F * zz - 2.0071396306718676F);
    put(1, 0.4886025119029199F * y);
    put(3, 0.4886025119029199F * x);
    put(5, first1 * y);
    put(7, first1 * x);
    put(11, second1 * y);
    put(13, second1 * x);
    put(19, third1 * y);
    put(21, third1 * x);

    const Vec c2 = x * x - y * y;
    const Vec s2 = 2.0F * x * y;
    const Vec first2 = 1.4453057213202769F * z;
    const Vec second2 = 3.3116114351514600F * zz - 0.4730873478787801F;
    put(4, 0.5462742152960396F * s2);
    put(8, 0.5462742152960396F * c2);
    put(10, first2 * s2);
    put(14, first2 * c2);
    put(18, second2 * s2);
    put(22, second2 * c2);

    const Vec c3 = x * c2 - y * s2;
    const Vec s3 = x * s2 + y * c2;
    const Vec first3 = 1.7701307697799304F * z;
    put(9, 0.5900435899266435F * s3);
    put(15, 0.5900435899266435F * c3);
    put(17, first3 * s3);
    put(23, first3 * c3);

    put(16, 0.6258357354491761F * (x * s3 + y * c3));
    put(24, 0.6258357354491761F * (x * c3 - y * s3));
}

/// As evaluate_sh().
template <typename Put>
ROWLAND_INLINE void evaluate_by_recurrence(Vec x, Vec y, Vec z, int bands, const Recurrence& factors, const Put& put) {
    Vec cosine = broadcast(1);
    Vec sine{};
    for (int m = 0; m < bands; ++m) {
        Vec before{};
        Vec legendre = broadcast(factors.diagonal[m]);
        for (int l = m; l < bands; ++l) {
            if (l > m) {
                const Vec next = factors.a[l * l + m] * z * legendre - factors.b[l * l + m] * before;
                before = legendre;
                legendre = next;
            }
            put(l * (l + 1) + m, legendre * cosine);
            if (m > 0) put(l * (l + 1) - m, legendre * sine);
        }
        const Vec turned = x * cosine - y * sine;
        sine = x * sine + y * cosine;
        cosine = turned;
    }
}

template <typename Put>
ROWLAND_INLINE void evaluate_lanes(Vec x, Vec y, Vec z, int bands, const Recurrence& factors, const Put& put) {
    if (bands == 5)
        evaluate_five_bands(x, y, z, put);
    else
        evaluate_by_recurrence(x, y, z, bands, factors, put);
}

/// See evaluate_sh_batch().
void evaluate(const Directions& directions, int bands, const Recurrence& factors, std::size_t stride, float* values) {
    std::size_t k = 0;
    for (; k + kLanes <= directions.count; k += kLanes)
        evaluate_lanes(load(directions.x + k), load(directions.y + k), load(directions.z + k), bands, factors,
                       [&](int i, Vec value) { store(values + static_cast<std::size_t>(i) * stride + k, value); });
    if (k == directions.count) return;
    const std::size_t rest = directions.count - k;
    float padded[3][kLanes] = {};
    for (std::size_t lane = 0; lane < rest; ++lane) {
        padded[0][lane] = directions.x[k + lane];
        padded[1][lane] = directions.y[k + lane];
        padded[2][lane] = directions.z[k + lane];
    }
    evaluate_lanes(load(padded[0]), load(padded[1]), load(padded[2]), bands, factors, [&](int i, Vec value) {
        float* row = values + static_cast<std::size_t>(i) * stride + k;
        for (std::size_t lane = 0; lane < rest; ++lane) row[lane] = value[static_cast<int>(lane)];
    });
}

// NOLINTEND(misc-definitions-in-headers)
}  // namespace
}  // namespace rowland::math::simd
