#include "engine/math/fourier_transform.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/check.h"

namespace rowland::math {

namespace {

constexpr std::size_t kFourierLanes = FourierTransform::kLanes;

/// One butterfly of all lanes: sum and rotated difference of two elements.
struct Butterfly {
    float cosine;
    float sine;
    void operator()(const float* __restrict ar, const float* __restrict ai, const float* __restrict br,
                    const float* __restrict bi, float* __restrict sum_r, float* __restrict sum_i,
                    float* __restrict rotated_r, float* __restrict rotated_i) const {
        for (std::size_t l = 0; l < kFourierLanes; ++l) {
            const float dr = ar[l] - br[l];
            const float di = ai[l] - bi[l];
            sum_r[l] = ar[l] + br[l];
            sum_i[l] = ai[l] + bi[l];
            rotated_r[l] = dr * cosine - di * sine;
            rotated_i[l] = dr * sine + di * cosine;
        }
    }
};

}  // namespace

FourierTransform::FourierTransform(std::size_t size) : size_(size), cosine_(size / 2), sine_(size / 2) {
    ROWLAND_CHECK(std::has_single_bit(size), "a transform's size is a power of two");
    for (std::size_t j = 0; j < size / 2; ++j) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(size);
        cosine_[j] = static_cast<float>(std::cos(angle));
        sine_[j] = static_cast<float>(std::sin(angle));
    }
}

void FourierTransform::operator()(Parts data, Parts work) const {
    ROWLAND_CHECK_OP(data.real.size(), ==, kLanes * size_);
    ROWLAND_CHECK_OP(work.real.size(), ==, kLanes * size_);
    Parts from = data;
    Parts to = work;
    // `stride` transforms of length `length` are interleaved.
    std::size_t stride = 1;
    for (std::size_t length = size_; length > 1; length /= 2, stride *= 2) {
        const std::size_t half = length / 2;
        for (std::size_t p = 0; p < half; ++p) {
            const Butterfly butterfly{cosine_[p * stride], sine_[p * stride]};
            for (std::size_t q = 0; q < stride; ++q) {
                const std::size_t a = kLanes * (q + stride * p);
                const std::size_t b = kLanes * (q + stride * (p + half));
                const std::size_t sum = kLanes * (q + stride * 2 * p);
                const std::size_t rotated = sum + kLanes * stride;
                butterfly(from.real.data() + a, from.imaginary.data() + a, from.real.data() + b,
                          from.imaginary.data() + b, to.real.data() + sum, to.imaginary.data() + sum,
                          to.real.data() + rotated, to.imaginary.data() + rotated);
            }
        }
        std::swap(from, to);
    }
    if (from.real.data() == data.real.data()) return;
    std::copy(from.real.begin(), from.real.end(), data.real.begin());
    std::copy(from.imaginary.begin(), from.imaginary.end(), data.imaginary.begin());
}

}  // namespace rowland::math
