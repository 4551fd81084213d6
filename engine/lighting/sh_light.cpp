#include "engine/lighting/sh_light.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/probe_image.h"
#include "engine/math/spherical_harmonics.h"

namespace rowland::lighting {

ShLight limit_bands(const ShLight& light, int bands, math::SphericalWindow window) {
    ROWLAND_CHECK_OP(bands, >=, 1);
    const int present = std::min(bands, light.bands);
    ShLight limited{.bands = bands, .coefficients = {}};
    for (int l = 0; l < present; ++l) {
        const double factor = math::window_factor(window, l, present);
        for (int m = -l; m <= l; ++m)
            limited.coefficients.push_back(factor * light.coefficients[static_cast<std::size_t>(math::sh_index(l, m))]);
    }
    limited.coefficients.resize(static_cast<std::size_t>(math::sh_count(bands)), glm::dvec3(0.0));
    return limited;
}

namespace {

using std::numbers::pi;

std::size_t to_size(int x) {
    return static_cast<std::size_t>(x);
}

/// Partial sums of a dot product, so that the compiler can use vectors without changing the result.
constexpr std::size_t kPartialSums = 4;

constexpr std::size_t kRowsPerTask = 16;

/// Fourier moments of one row, with φ = 0 at its middle: Σ L cos mφ for m ≥ 0, Σ L sin |m|φ for m < 0, at index
/// m + bands − 1.
using Moments = std::vector<glm::dvec3>;

/// cos(mφ) and sin(mφ), m < bands, of the columns right of the middle, φ ≥ 0; zeros up to `padded`.
struct Waves {
    int bands;
    std::size_t columns;
    std::size_t padded;
    std::vector<double> cosine;  ///< bands × padded
    std::vector<double> sine;

    Waves(int width, int bands_)
        : bands(bands_),
          columns(to_size(width - width / 2)),
          padded((columns + kPartialSums - 1) / kPartialSums * kPartialSums),
          cosine(to_size(bands) * padded),
          sine(to_size(bands) * padded) {
        parallel_for(to_size(bands), [&](std::size_t m) {
            for (std::size_t j = 0; j < columns; ++j) {
                const double phi = 2 * pi * ((static_cast<double>(to_size(width / 2) + j) + 0.5) / width - 0.5);
                cosine[m * padded + j] = std::cos(static_cast<double>(m) * phi);
                sine[m * padded + j] = std::sin(static_cast<double>(m) * phi);
            }
        });
    }
};

/// A row folded about its middle column, channel after channel: L(φ) + L(−φ) for the cosines, L(φ) − L(−φ) for the
/// sines.
struct FoldedRow {
    std::vector<double> even;  ///< 3 × padded
    std::vector<double> odd;

    explicit FoldedRow(std::size_t padded) : even(3 * padded), odd(3 * padded) {}

    void fold(const image::Image& image, int row, const Waves& waves) {
        const glm::vec3* texels = image.texels.data() + to_size(row) * to_size(image.width);
        const std::size_t middle = to_size(image.width / 2);
        for (std::size_t j = 0; j < waves.columns; ++j) {
            const glm::dvec3 right(texels[middle + j]);
            const std::size_t mirrored = to_size(image.width) - 1 - middle - j;
            // An odd width's middle column is its own mirror image.
            const glm::dvec3 left = mirrored == middle + j ? glm::dvec3(0.0) : glm::dvec3(texels[mirrored]);
            for (int c = 0; c < 3; ++c) {
                even[to_size(c) * waves.padded + j] = right[c] + left[c];
                odd[to_size(c) * waves.padded + j] = right[c] - left[c];
            }
        }
    }
};

/// Σ wave·channel over the columns, for three channels.
glm::dvec3 dot(const double* wave, const double* channels, std::size_t padded) {
    double sums[3][kPartialSums] = {};
    for (std::size_t j = 0; j < padded; j += kPartialSums)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < kPartialSums; ++k) sums[c][k] += wave[j + k] * channels[c * padded + j + k];
    glm::dvec3 result;
    for (int c = 0; c < 3; ++c) result[c] = (sums[c][0] + sums[c][1]) + (sums[c][2] + sums[c][3]);
    return result;
}

Moments row_moments(const FoldedRow& row, const Waves& waves) {
    Moments moments(to_size(2 * waves.bands - 1), glm::dvec3(0.0));
    for (int m = 0; m < waves.bands; ++m) {
        const std::size_t first = to_size(m) * waves.padded;
        moments[to_size(waves.bands - 1 + m)] = dot(&waves.cosine[first], row.even.data(), waves.padded);
        if (m > 0) moments[to_size(waves.bands - 1 - m)] = dot(&waves.sine[first], row.odd.data(), waves.padded);
    }
    return moments;
}

std::vector<Moments> all_row_moments(const image::Image& image, const Waves& waves) {
    std::vector<Moments> rows(to_size(image.height));
    parallel_for((rows.size() + kRowsPerTask - 1) / kRowsPerTask, [&](std::size_t task) {
        FoldedRow folded(waves.padded);
        const std::size_t end = std::min(rows.size(), (task + 1) * kRowsPerTask);
        for (std::size_t row = task * kRowsPerTask; row < end; ++row) {
            folded.fold(image, static_cast<int>(row), waves);
            rows[row] = row_moments(folded, waves);
        }
    });
    return rows;
}

/// In a frame whose polar axis is the image's, Y_lm is a Legendre function of the row times cos mφ or sin mφ of the
/// column. So n bands take 2n − 1 sums per texel instead of n², over folded rows, and one rotation into world axes.
/// Sums are in double and in fixed order.
std::vector<glm::dvec3> project_equirectangular(const ProbeImage& probe, int bands) {
    const image::Image& image = probe.image();
    const Waves waves(image.width, bands);
    const std::vector<Moments> rows = all_row_moments(image, waves);

    const auto count = to_size(math::sh_count(bands));
    std::vector<glm::dvec3> in_image_frame(count, glm::dvec3(0.0));
    std::vector<double> legendre(count);
    for (int row = 0; row < image.height; ++row) {
        const double theta = pi * (row + 0.5) / image.height;
        math::evaluate_sh({std::sin(theta), 0, std::cos(theta)}, bands, legendre);  // cos mφ = 1
        const double weight = probe.solid_angle(0, row);
        for (int l = 0; l < bands; ++l)
            for (int m = -l; m <= l; ++m)
                in_image_frame[to_size(math::sh_index(l, m))] += weight *
                                                                 legendre[to_size(math::sh_index(l, std::abs(m)))] *
                                                                 rows[to_size(row)][to_size(bands - 1 + m)];
    }
    // The image's frame in world axes: φ = 0 is −Z, the pole is +Y, and φ grows toward +X, which is left-handed. So the
    // third axis is −X and odd terms change sign.
    for (int l = 0; l < bands; ++l)
        for (int m = -l; m < 0; ++m) in_image_frame[to_size(math::sh_index(l, m))] *= -1.0;
    const glm::dmat3 to_world(glm::dvec3(0, 0, -1), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0));
    std::vector<glm::dvec3> coefficients(count);
    math::ShRotation(to_world, bands).apply(in_image_frame, coefficients);
    return coefficients;
}

/// Sum of L Y ΔΩ over some rows, and of ΔΩ.
struct RowSum {
    std::vector<glm::dvec3> coefficients;
    double solid_angle = 0;
};

RowSum sum_rows(const ProbeImage& probe, int first, int end, int bands) {
    const auto count = to_size(math::sh_count(bands));
    RowSum sum{std::vector<glm::dvec3>(count, glm::dvec3(0.0))};
    std::vector<double> values(count);
    for (int row = first; row < end; ++row)
        for (int column = 0; column < probe.image().width; ++column) {
            const double solid_angle = probe.solid_angle(column, row);
            if (solid_angle == 0) continue;
            sum.solid_angle += solid_angle;
            math::evaluate_sh(probe.direction(column + 0.5, row + 0.5), bands, values);
            const glm::dvec3 light = solid_angle * glm::dvec3(probe.image().at(column, row));
            for (std::size_t i = 0; i < count; ++i) sum.coefficients[i] += values[i] * light;
        }
    return sum;
}

std::vector<glm::dvec3> project_angular(const ProbeImage& probe, int bands) {
    constexpr int kRows = 16;  // per block; the blocks do not depend on the number of threads
    const int height = probe.image().height;
    std::vector<RowSum> blocks(to_size((height + kRows - 1) / kRows));
    parallel_for(blocks.size(), [&](std::size_t i) {
        const int first = static_cast<int>(i) * kRows;
        blocks[i] = sum_rows(probe, first, std::min(height, first + kRows), bands);
    });
    std::vector<glm::dvec3> coefficients(to_size(math::sh_count(bands)), glm::dvec3(0.0));
    double solid_angle = 0;
    for (const RowSum& block : blocks) {
        solid_angle += block.solid_angle;
        for (std::size_t i = 0; i < coefficients.size(); ++i) coefficients[i] += block.coefficients[i];
    }
    for (glm::dvec3& c : coefficients) c *= 4 * pi / solid_angle;
    return coefficients;
}

}  // namespace

ShLight project(const ProbeImage& probe, int bands) {
    ROWLAND_CHECK_OP(bands, >=, 1);
    ROWLAND_CHECK_OP(bands, <=, math::kMaximumBands);
    if (probe.mapping() == Mapping::Angular) return {bands, project_angular(probe, bands)};
    return {bands, project_equirectangular(probe, bands)};  // these solid angles sum to 4π as they are
}

}  // namespace rowland::lighting
