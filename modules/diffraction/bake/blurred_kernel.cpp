#include "modules/diffraction/bake/blurred_kernel.h"

#include <algorithm>
#include <cmath>

#include "engine/colour/sampled_spectrum.h"
#include "engine/core/check.h"
#include "engine/core/parallel.h"

namespace rowland::diffraction {

namespace {

/// The sun on a grating of 700 nm is 1.4 nm wide.
constexpr double kNarrowest_nm = 1.0;

/// What a look-up adds to a level's variance, in squares of a column's width: the mean over a column 1/12, and linear
/// interpolation, which is above f by f''/12 on average, 1/6.
constexpr double kColumnVariance = 0.25;
/// Of a stencil of one column.
constexpr double kLeastVariance = 1e-4;

/// A normal distribution ends after this many deviations: 6e-5 of it is lost.
constexpr double kBlurReach = 4.0;

/// 1/√κ of the widest lobe that is fitted to a probe, with a margin for the pixel.
constexpr double kWidestDeviation = 0.2;
/// Columns for lights: one per so many nm, within the limits below.
constexpr double kColumn_nm = 2.0;
constexpr int kFewestColumns = 1024;

/// Weights of a normal distribution in cells of width `step`, normalised: of cells 0, ±1, ±2, … from its centre.
std::vector<double> stencil(double deviation, double step) {
    std::vector<double> weights;
    double sum = 0.0;
    for (int i = 0; i * step <= kBlurReach * deviation; ++i) {
        const double scale = 1.0 / (std::sqrt(2.0) * deviation);
        weights.push_back(0.5 * (std::erf((i + 0.5) * step * scale) - std::erf((i - 0.5) * step * scale)));
        sum += (i == 0 ? 1.0 : 2.0) * weights.back();
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

}  // namespace

glm::dmat3 BlurredKernel::at(double x_nm, double deviation_nm) const {
    const auto interpolate = [](double position, int count, int& low) {
        const double inside = std::clamp(position, 0.0, static_cast<double>(count - 1));
        low = std::min(static_cast<int>(inside), count - 2);
        return inside - low;
    };
    int column = 0;
    int level = 0;
    const double s = interpolate((x_nm - begin_nm) / (end_nm - begin_nm) * (columns - 1), columns, column);
    const double t =
        interpolate(std::log2(std::max(deviation_nm, narrowest_nm) / narrowest_nm) * levels_per_octave, levels, level);
    const auto value = [&](int i, int j) {
        return glm::dmat3(
            values[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i)]);
    };
    return (1.0 - t) * ((1.0 - s) * value(column, level) + s * value(column + 1, level)) +
           t * ((1.0 - s) * value(column, level + 1) + s * value(column + 1, level + 1));
}

BlurredKernel blur(const KernelTable& kernel, double widest_nm, int columns, int levels_per_octave) {
    ROWLAND_CHECK_OP(widest_nm, >=, kNarrowest_nm);
    ROWLAND_CHECK_OP(columns, >=, 2);
    BlurredKernel blurred{
        .narrowest_nm = kNarrowest_nm, .columns = columns, .levels_per_octave = levels_per_octave, .values = {}};
    blurred.levels = 2 + static_cast<int>(std::ceil(std::log2(widest_nm / kNarrowest_nm) * levels_per_octave));
    const auto deviation_of = [&](int level) {
        return kNarrowest_nm * std::exp2(static_cast<double>(level) / levels_per_octave);
    };
    const double margin = kBlurReach * deviation_of(blurred.levels - 1) + 1.0;
    blurred.begin_nm = kernel.begin_nm - margin;
    blurred.end_nm = kernel.end_nm + margin;
    const auto size = static_cast<std::size_t>(columns);
    const double step = (blurred.end_nm - blurred.begin_nm) / (columns - 1);
    std::vector<glm::dmat3> means(size);
    for (std::size_t i = 0; i < size; ++i) {
        const double x = blurred.begin_nm + static_cast<double>(i) * step;
        means[i] = kernel.average(x - 0.5 * step, x + 0.5 * step);
    }
    blurred.values.resize(size * static_cast<std::size_t>(blurred.levels));
    parallel_for(static_cast<std::size_t>(blurred.levels), [&](std::size_t level) {
        const double deviation = deviation_of(static_cast<int>(level));
        const double left = deviation * deviation - kColumnVariance * step * step;
        const std::vector<double> weights = stencil(std::sqrt(std::max(left, kLeastVariance * step * step)), step);
        for (std::size_t i = 0; i < size; ++i) {
            glm::dmat3 sum = weights[0] * means[i];
            for (std::size_t j = 1; j < weights.size(); ++j) {
                if (i >= j) sum += weights[j] * means[i - j];
                if (i + j < size) sum += weights[j] * means[i + j];
            }
            blurred.values[level * size + i] = glm::mat3(sum);
        }
    });
    return blurred;
}

BlurredKernel blur_for_lights(const KernelTable& kernel, double pitch_nm, int most_columns, int levels_per_octave) {
    const double widest_nm = std::max(kNarrowest_nm, kWidestDeviation * pitch_nm);
    const double extent_nm = kernel.end_nm - kernel.begin_nm + 8.0 * widest_nm;
    const double columns = std::clamp(extent_nm / kColumn_nm, double{kFewestColumns}, double(most_columns));
    return blur(kernel, widest_nm, static_cast<int>(columns), levels_per_octave);
}

KernelUniforms kernel_uniforms(const KernelTable& kernel, const BlurredKernel& blurred, double pitch_nm) {
    const double step = 1.0 / blurred.columns;
    const double per_nm = (1.0 - step) / (blurred.end_nm - blurred.begin_nm);
    const double narrowest = blurred.narrowest_nm / pitch_nm;
    const double rows = static_cast<double>(blurred.levels_per_octave) / blurred.levels;
    const double nearest = colour::kVisibleMin / pitch_nm;
    const double farthest = std::max(std::abs(kernel.begin_nm), std::abs(kernel.end_nm)) / pitch_nm;
    return {.scale_bias = glm::dvec4(pitch_nm * per_nm, 0.5 * step - blurred.begin_nm * per_nm, narrowest, pitch_nm),
            .rows = glm::dvec2(rows, 0.5 / blurred.levels - rows * std::log2(narrowest)),
            .reach = 0.5 * glm::dvec2(farthest + nearest, farthest - nearest)};
}

}  // namespace rowland::diffraction
