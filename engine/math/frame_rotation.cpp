#include "engine/math/frame_rotation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/mat3x3.hpp>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/math/frame_rotation_kernels.h"
#include "engine/math/spherical_harmonics.h"

namespace rowland::math {

const char* instruction_set_name(InstructionSet set) {
    return set == InstructionSet::Avx2 ? "avx2" : "baseline";
}

bool is_supported(InstructionSet set) {
    if (set == InstructionSet::Baseline) return true;
#ifdef ROWLAND_MATH_AVX2
    return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#else
    return false;
#endif
}

InstructionSet best_instruction_set() {
    return is_supported(InstructionSet::Avx2) ? InstructionSet::Avx2 : InstructionSet::Baseline;
}

namespace {

simd::Kernels kernels_of(InstructionSet set) {
    ROWLAND_CHECK(is_supported(set), "this processor or this build lacks the instruction set asked for");
#ifdef ROWLAND_MATH_AVX2
    if (set == InstructionSet::Avx2) return simd::avx2_kernels();
#endif
    return {simd::rotate, simd::project};
}

constexpr std::size_t kFramesPerTask = 512;  // a multiple of every set's lanes
constexpr std::size_t kChannels = 3;

void check_bands(int bands) {
    ROWLAND_CHECK_OP(bands, >=, 1);
    ROWLAND_CHECK_OP(bands, <=, kMaximumFastBands);
}

/// Non-zero entries of the matrix that exchanges y and z, row after row; light of fewer bands uses the first of them.
/// The exchange is a rotation and a point reflection, which multiplies band l by (−1)^l; this factor is left out, since
/// light is always exchanged twice.
std::vector<float> make_exchange() {
    const glm::dmat3 rotation(glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, -1, 0));
    const ShRotation exchange(rotation, kMaximumFastBands);
    std::vector<float> entries;
    for (int l = 0; l < kMaximumFastBands; ++l)
        for (int m = -l; m <= l; ++m) {
            const simd::ExchangeColumns columns = simd::exchange_columns(l, m);
            for (int k = columns.first; k <= l; k += 2)
                entries.push_back(static_cast<float>(exchange.entry(l, m, columns.sign * k)));
        }
    return entries;
}

/// Light in single precision, ready for the kernels.
struct FloatLight {
    std::vector<float> coefficients;
    int bands;

    FloatLight(std::span<const glm::dvec3> light, int bands_) : bands(bands_) {
        check_bands(bands);
        const auto count = static_cast<std::size_t>(sh_count(bands));
        ROWLAND_CHECK_OP(light.size(), ==, count);
        for (const glm::dvec3& rgb : light)
            for (int c = 0; c < 3; ++c) coefficients.push_back(static_cast<float>(rgb[c]));
    }

    simd::Light view() const {
        static const std::vector<float> exchange = make_exchange();
        return {coefficients.data(), bands, exchange.data()};
    }
};

void check_frames(const FrameArrays& frames) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        ROWLAND_CHECK_OP(frames.tangent[axis].size(), ==, frames.size());
        ROWLAND_CHECK_OP(frames.normal[axis].size(), ==, frames.size());
    }
}

/// Splits the frames into blocks and calls body(block, index of its first frame) for each, on all cores.
template <typename Body>
void for_each_block(const FrameArrays& frames, const Body& body) {
    check_frames(frames);
    parallel_for((frames.size() + kFramesPerTask - 1) / kFramesPerTask, [&](std::size_t task) {
        const std::size_t first = task * kFramesPerTask;
        simd::Frames block{{}, {}, std::min(kFramesPerTask, frames.size() - first)};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            block.tangent[axis] = frames.tangent[axis].data() + first;
            block.normal[axis] = frames.normal[axis].data() + first;
        }
        body(block, first);
    });
}

}  // namespace

void rotate_to_frames(std::span<const glm::dvec3> light, int bands, const FrameArrays& frames, std::span<float> out,
                      InstructionSet set) {
    const FloatLight source(light, bands);
    const std::size_t per_frame = light.size() * kChannels;
    ROWLAND_CHECK_OP(out.size(), >=, frames.size() * per_frame);
    const simd::Kernels kernels = kernels_of(set);
    for_each_block(frames, [&](const simd::Frames& block, std::size_t first) {
        kernels.rotate(source.view(), block, out.data() + first * per_frame);
    });
}

FrameProjection::FrameProjection(std::span<const double> matrix, int bands) : bands_(bands) {
    check_bands(bands);
    const auto columns = static_cast<std::size_t>(sh_count(bands));
    ROWLAND_CHECK(!matrix.empty() && matrix.size() % columns == 0, "a projection needs whole rows of bands² entries");
    ROWLAND_CHECK_OP(matrix.size() / columns, <=, std::size_t{256});
    double largest = 0;
    for (const double entry : matrix) largest = std::max(largest, std::abs(entry));
    first_.push_back(0);
    for (std::size_t row = 0; row < matrix.size() / columns; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const double entry = matrix[row * columns + column];
            if (std::abs(entry) <= 1e-9 * largest) continue;
            column_.push_back(static_cast<std::int32_t>(column));
            weight_.push_back(static_cast<float>(entry));
        }
        first_.push_back(static_cast<std::int32_t>(column_.size()));
    }
}

void rotate_and_project(std::span<const glm::dvec3> light, const FrameArrays& frames, const FrameProjection& projection,
                        std::span<float> out, InstructionSet set) {
    const FloatLight source(light, projection.bands());
    const std::size_t per_frame = static_cast<std::size_t>(projection.rows()) * kChannels;
    ROWLAND_CHECK_OP(out.size(), >=, frames.size() * per_frame);
    const simd::SparseMatrix matrix{projection.rows(), projection.first().data(), projection.column().data(),
                                    projection.weight().data()};
    const simd::Kernels kernels = kernels_of(set);
    for_each_block(frames, [&](const simd::Frames& block, std::size_t first) {
        kernels.project(source.view(), block, matrix, out.data() + first * per_frame);
    });
}

}  // namespace rowland::math
