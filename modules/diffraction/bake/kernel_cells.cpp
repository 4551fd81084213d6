#include "modules/diffraction/bake/kernel_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>

#include "engine/colour/spectrum.h"
#include "engine/core/check.h"
#include "engine/core/parallel.h"

namespace rowland::diffraction {

namespace {

constexpr std::size_t kWeightFloats = 12;

}  // namespace

KernelCells::KernelCells(const KernelTable& kernel, double pitch_nm, int views, const glm::dmat3& zero_order_xyz)
    : views_(views), cells_(2 * (views - 1)) {
    ROWLAND_CHECK_OP(views, >=, 2);
    ROWLAND_CHECK_OP(pitch_nm, >, 0.0);
    const int sums = 2 * cells_;
    const double step = 2.0 / cells_;
    const double density = 1.0 / step;
    const auto weight_of = [&](int sum, double v_g) {
        const double begin = pitch_nm * (sum * step - 2.0);
        const double end = pitch_nm * ((sum + 1) * step - 2.0);
        glm::dmat3 weight = kernel.at(end, v_g) - kernel.at(begin, v_g);
        // Order 0, δ(u), is spread over the four cells around u = 0; with fewer the image shows single texels.
        const int from_zero = std::abs(2 * sum + 1 - sums);
        if (from_zero <= 3) weight += (from_zero == 1 ? 0.375 : 0.125) * zero_order_xyz;
        return density * weight;
    };
    first_ = sums;
    const auto set = [&](std::size_t index, int sum, const glm::dmat3& weight) {
        if (weight == glm::dmat3(0.0)) return;
        for (int c = 0; c < 3; ++c)
            for (int o = 0; o < 3; ++o)
                weights_[index * kWeightFloats + static_cast<std::size_t>(4 * c + o)] =
                    static_cast<float>(weight[c][o]);
        first_ = std::min(first_, sum);
        end_ = std::max(end_, sum + 1);
    };
    if (kernel.views == 1) {
        weights_.assign(static_cast<std::size_t>(sums) * kWeightFloats, 0.0F);
        for (int sum = 0; sum < sums; ++sum) set(static_cast<std::size_t>(sum), sum, weight_of(sum, 0.0));
        return;
    }
    view_stride_ = static_cast<std::size_t>(cells_);
    weights_.assign(static_cast<std::size_t>(views) * view_stride_ * kWeightFloats, 0.0F);
    for (int view = 0; view < views; ++view)
        for (int cell = 0; cell < cells_; ++cell)
            set(static_cast<std::size_t>(view) * view_stride_ + static_cast<std::size_t>(cell), cell + 2 * view,
                weight_of(cell + 2 * view, 2.0 * view / (views - 1) - 1.0));
}

const float* KernelCells::weights(int view, int cell) const {
    return weights_.data() +
           (static_cast<std::size_t>(view) * view_stride_ + static_cast<std::size_t>(cell)) * kWeightFloats;
}

KernelCells::Range KernelCells::range(int view) const {
    return {std::clamp(first_ - 2 * view, 0, cells_), std::clamp(end_ - 2 * view, 0, cells_)};
}

template <typename Value>
void KernelCells::sharpen(std::span<Value> xyz, std::size_t count) const {
    std::vector<Value> before(xyz.begin(), xyz.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = count; i + count < xyz.size(); ++i) {
        const Value here = xyz[i];
        Value& left = before[i % count];
        xyz[i] -= kBestView * (left - 2.0F * here + xyz[i + count]);
        left = here;
    }
}

template <int kFours>
void KernelCells::correlate(std::span<const Four> light, std::span<Four> xyz) const {
    constexpr std::size_t kSums = kFours % 10 == 0 ? 10 : 12;  // as many as registers hold
    static_assert(kFours % kSums == 0);
    for (int view = 0; view < views_; ++view) {
        const Range reached = range(view);
        for (std::size_t i = 0; i < std::size_t{3} * kFours; i += kSums) {
            const float* weight = weights(view, reached.begin) + i / kFours;
            const Four* from = light.data() + static_cast<std::size_t>(reached.begin) * 3 * kFours + i % kFours;
            std::array<Four, kSums> sum{};
            for (int cell = reached.begin; cell < reached.end;
                 ++cell, weight += kWeightFloats, from += std::ptrdiff_t{3} * kFours)
                for (std::size_t k = 0; k < kSums; ++k)
                    sum[k] += weight[0] * from[k] + weight[4] * from[kFours + k] +
                              weight[8] * from[std::size_t{2} * kFours + k];
            std::copy(sum.begin(), sum.end(),
                      xyz.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(view) * 3 * kFours + i));
        }
    }
    sharpen(xyz, std::size_t{3} * kFours);
}

template void KernelCells::correlate<10>(std::span<const Four> light, std::span<Four> xyz) const;
template void KernelCells::correlate<20>(std::span<const Four> light, std::span<Four> xyz) const;
template void KernelCells::correlate<24>(std::span<const Four> light, std::span<Four> xyz) const;

void KernelCells::correlate_rgb(std::span<const float> light, std::span<float> xyz) const {
    for (int view = 0; view < views_; ++view) {
        std::array<float, 4> sum{};
        const Range reached = range(view);
        const float* weight = weights(view, reached.begin);
        const float* from = light.data() + static_cast<std::size_t>(reached.begin) * 4;
        for (int cell = reached.begin; cell < reached.end; ++cell, weight += kWeightFloats, from += 4)
            for (std::size_t o = 0; o < 4; ++o)
                sum[o] += weight[o] * from[0] + weight[4 + o] * from[1] + weight[8 + o] * from[2];
        std::copy(sum.begin(), sum.end(), xyz.begin() + static_cast<std::ptrdiff_t>(view) * 4);
    }
    sharpen(xyz, 4);
}

namespace {

/// σ of level 0. The sun on a grating of 700 nm is 1.4 nm wide.
constexpr double kNarrowest_nm = 1.0;

/// Levels are summed in columns as wide as this fraction of their deviation, or less.
constexpr double kWidestColumn = 1.0 / 6.0;

/// Least 2 − |u|, below which no order is left.
constexpr double kLeastViews = 1e-3;

/// A normal distribution is cut off at this many deviations: 6e-5 of it is lost.
constexpr double kBlurReach = 4.0;

/// 1/√κ of the widest key light that is fitted to a probe, with a margin for the pixel.
constexpr double kWidestDeviation = 0.2;
/// Columns for lights: one per so many nm, within the limits below.
constexpr double kColumn_nm = 2.0;
constexpr int kFewestColumns = 1024;

/// Means of a normal distribution over columns 0, ±1, ±2, … from its centre, normalised. `deviation`: in columns.
std::vector<float> stencil(double deviation) {
    std::vector<float> weights(1 + static_cast<std::size_t>(kBlurReach * deviation));
    const double scale = 1.0 / (std::sqrt(2.0) * deviation);
    float sum = 0.0F;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto x = static_cast<double>(i);
        weights[i] = static_cast<float>(std::erf((x + 0.5) * scale) - std::erf((x - 0.5) * scale));
        sum += (i == 0 ? 1.0F : 2.0F) * weights[i];
    }
    for (float& weight : weights) weight /= sum;
    return weights;
}

/// The width of the wide columns in which a level of this deviation is summed; both in columns.
std::size_t wide_column(double deviation) {
    return static_cast<std::size_t>(std::max(1.0, kWidestColumn * deviation));
}

/// The variance of a level's stencil, in squares of its columns, which are `width` columns wide. A look-up adds to it
/// the means over a column, 1/12, over a wide column, and of the stencil over a wide column, and linear interpolation,
/// which is above f by f''/12 on average, 1/6.
double stencil_variance(double deviation, std::size_t width) {
    constexpr double kLeast = 1e-4;  // of a stencil of one column
    const auto square = static_cast<double>(width * width);
    return std::max(kLeast, (deviation * deviation - 0.25 - (square - 1.0) / 6.0) / square - 1.0 / 12.0);
}

using Columns = std::vector<glm::mat3>;

/// sum += factor · value
void add(glm::mat3& sum, float factor, const glm::mat3& value) {
    float* const to = glm::value_ptr(sum);
    const float* const from = glm::value_ptr(value);
    for (int i = 0; i < 9; ++i) to[i] += factor * from[i];
}

/// Adds what a symmetric stencil sums around column i; `columns` are 0 beyond their ends.
void add_sum(std::span<const glm::mat3> columns, std::size_t i, std::span<const float> weights, float factor,
             glm::mat3& sum) {
    const std::size_t reach = weights.size() - 1;
    glm::mat3 total = sum;  // in registers
    for (std::size_t j = std::max(i, reach) - reach; j < std::min(i + reach + 1, columns.size()); ++j)
        add(total, factor * weights[std::max(i, j) - std::min(i, j)], columns[j]);
    sum = total;
}

/// Adds the cubic through the four wide columns around a column; they are 0 beyond their ends.
void add_cubic(std::span<const glm::mat3> wide, std::size_t width, std::size_t column, glm::mat3& sum) {
    const float t = static_cast<float>(column % width) / static_cast<float>(width);
    const std::array factors{-t * (t - 1.0F) * (t - 2.0F) / 6.0F, (t + 1.0F) * (t - 1.0F) * (t - 2.0F) / 2.0F,
                             -(t + 1.0F) * t * (t - 2.0F) / 2.0F, (t + 1.0F) * t * (t - 1.0F) / 6.0F};
    for (std::size_t j = 0; j < factors.size(); ++j) {
        const std::size_t after = column / width + j;  // the index of the next wide column
        if (after > 0 && after <= wide.size()) add(sum, factors[j], wide[after - 1]);
    }
}

BlurLayout layout_of(const KernelTable& kernel, double pitch_nm, double widest_nm, int columns, int levels_per_octave) {
    ROWLAND_CHECK_OP(widest_nm, >=, kNarrowest_nm);
    ROWLAND_CHECK_OP(columns, >=, 2);
    BlurLayout layout{.narrowest_nm = kNarrowest_nm,
                      .columns = columns,
                      .levels_per_octave = levels_per_octave,
                      .views = kernel.views == 1 ? 1 : kBlurredViews,
                      .pitch_nm = pitch_nm};
    layout.levels = 2 + static_cast<int>(std::ceil(std::log2(widest_nm / kNarrowest_nm) * levels_per_octave));
    const double widest = kNarrowest_nm * std::exp2(static_cast<double>(layout.levels - 1) / levels_per_octave);
    const double margin = kBlurReach * widest + 1.0;
    layout.begin_nm = kernel.begin_nm - margin;
    layout.end_nm = kernel.end_nm + margin;
    return layout;
}

}  // namespace

double view_coordinate(double u, double v_g) {
    return std::clamp((2.0 * v_g - u) / std::max(2.0 - std::abs(u), kLeastViews), -1.0, 1.0);
}

glm::dmat3 BlurredKernel::at(double x_nm, double deviation_nm, double v_g) const {
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
    const auto of_view = [&](int view) {
        const auto value = [&](int i, int j) {
            return glm::dmat3(values[static_cast<std::size_t>(view * levels + j) * static_cast<std::size_t>(columns) +
                                     static_cast<std::size_t>(i)]);
        };
        return (1.0 - t) * ((1.0 - s) * value(column, level) + s * value(column + 1, level)) +
               t * ((1.0 - s) * value(column, level + 1) + s * value(column + 1, level + 1));
    };
    if (views == 1) return of_view(0);
    int view = 0;
    const double r = interpolate(0.5 * (view_coordinate(x_nm / pitch_nm, v_g) + 1.0) * (views - 1), views, view);
    return (1.0 - r) * of_view(view) + r * of_view(view + 1);
}

BlurredKernel blur(const KernelTable& kernel, const BlurLayout& layout) {
    const auto size = static_cast<std::size_t>(layout.columns);
    const double step = (layout.end_nm - layout.begin_nm) / (layout.columns - 1);
    const auto levels = static_cast<std::size_t>(layout.levels);
    const auto views = static_cast<std::size_t>(layout.views);
    const auto x_of = [&](std::size_t column) { return layout.begin_nm + static_cast<double>(column) * step; };
    const auto kernel_views = static_cast<std::size_t>(kernel.views);
    Columns means(kernel_views * size);
    parallel_for(kernel_views, [&](std::size_t view) {
        for (std::size_t i = 0; i < size; ++i)
            means[view * size + i] = kernel.average(x_of(i) - 0.5 * step, x_of(i) + 0.5 * step,
                                                    EfficiencyGrid::view_at(static_cast<int>(view)));
    });
    BlurredKernel blurred{layout, Columns(views * levels * size, glm::mat3(0.0F))};
    parallel_for(levels, [&](std::size_t level) {
        const double deviation =
            layout.narrowest_nm * std::exp2(static_cast<double>(level) / layout.levels_per_octave) / step;
        const std::size_t width = wide_column(deviation);
        const std::vector<float> weights = stencil(std::sqrt(stencil_variance(deviation, width)));
        // Means under triangles leave little of what would be an alias.
        std::vector<float> triangle(width);
        for (std::size_t i = 0; i < width; ++i)
            triangle[i] = static_cast<float>(width - i) / static_cast<float>(width * width);
        const std::size_t count = (size + width - 1) / width + 1;
        Columns wide(kernel_views * count, glm::mat3(0.0F));
        const auto wide_of = [&](std::size_t view) { return std::span(wide).subspan(view * count, count); };
        for (std::size_t view = 0; view < kernel_views; ++view)
            for (std::size_t i = 0; i < count; ++i)
                add_sum(std::span(means).subspan(view * size, size), i * width, triangle, 1.0F, wide_of(view)[i]);
        for (std::size_t view = 0; view < views; ++view) {
            const double coordinate = 2.0 * static_cast<double>(view) / (kBlurredViews - 1) - 1.0;
            Columns sums(count, glm::mat3(0.0F));
            for (std::size_t i = 0; i < count; ++i) {
                const double u = x_of(i * width) / layout.pitch_nm;
                EfficiencyGrid::ViewCell cell;
                if (views > 1)
                    cell = EfficiencyGrid::view_cell(0.5 * (u + coordinate * std::max(2.0 - std::abs(u), 0.0)));
                const auto part = static_cast<float>(cell.weight);
                for (std::size_t j = 0; j < std::min(kernel_views, std::size_t{2}); ++j)
                    add_sum(wide_of(cell.first + j), i, weights, j == 0 ? 1.0F - part : part, sums[i]);
            }
            for (std::size_t i = 0; i < size; ++i)
                add_cubic(sums, width, i, blurred.values[(view * levels + level) * size + i]);
        }
    });
    return blurred;
}

BlurredKernel blur(const KernelTable& kernel, double pitch_nm, double widest_nm, int columns, int levels_per_octave) {
    return blur(kernel, layout_of(kernel, pitch_nm, widest_nm, columns, levels_per_octave));
}

BlurLayout layout_for_lights(const KernelTable& kernel, double pitch_nm, int most_columns, int levels_per_octave) {
    const double widest_nm = std::max(kNarrowest_nm, kWidestDeviation * pitch_nm);
    const double extent_nm = kernel.end_nm - kernel.begin_nm + 8.0 * widest_nm;
    const auto columns =
        static_cast<int>(std::clamp(extent_nm / kColumn_nm, double{kFewestColumns}, double(most_columns)));
    if (kernel.views == 1) return layout_of(kernel, pitch_nm, widest_nm, columns, levels_per_octave);
    return layout_of(kernel, pitch_nm, widest_nm, columns / 2, std::max(1, levels_per_octave - 1));
}

BlurredKernel blur_for_lights(const KernelTable& kernel, double pitch_nm, int most_columns, int levels_per_octave) {
    return blur(kernel, layout_for_lights(kernel, pitch_nm, most_columns, levels_per_octave));
}

KernelUniforms kernel_uniforms(const KernelTable& kernel, const BlurLayout& layout) {
    const double pitch_nm = layout.pitch_nm;
    const double step = 1.0 / layout.columns;
    const double per_nm = (1.0 - step) / (layout.end_nm - layout.begin_nm);
    const double narrowest = layout.narrowest_nm / pitch_nm;
    const double rows = static_cast<double>(layout.levels_per_octave) / layout.levels;
    const double nearest = colour::kVisibleMin / pitch_nm;
    const double farthest = std::max(std::abs(kernel.begin_nm), std::abs(kernel.end_nm)) / pitch_nm;
    return {.scale_bias = glm::dvec4(pitch_nm * per_nm, 0.5 * step - layout.begin_nm * per_nm, narrowest, pitch_nm),
            .rows = glm::dvec2(rows, 0.5 / layout.levels - rows * std::log2(narrowest)),
            .reach = 0.5 * glm::dvec2(farthest + nearest, farthest - nearest)};
}

glm::vec3 kernel_views(const BlurLayout& layout, std::size_t layers, std::size_t first) {
    const double views = layout.views;
    return glm::dvec3(1.0, (views - 1.0) / views, 0.5 / views - static_cast<double>(first)) /
           static_cast<double>(layers);
}

}  // namespace rowland::diffraction
