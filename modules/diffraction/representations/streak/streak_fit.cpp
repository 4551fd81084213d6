#include "modules/diffraction/representations/streak/streak_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

namespace rowland::diffraction {

namespace {

/// Of the kernel's sum on each side of x = 0: so much lies beyond the first and the last node.
constexpr double kBeyondNodes = 0.015;
/// Added to the diagonal of the fit, in proportion.
constexpr double kRidge = 1e-3;

/// Least squares of the sum of the nodes' normal distributions against one element of the kernel, by weights that are
/// not negative: the kernel is not either, and a light narrower than a node would show a negative weight as a dark
/// spot. Coordinate descent; neighbours overlap by half, so that an eighth of the error is left by five sweeps.
std::vector<double> fit_element(const std::vector<double>& nodes, double width_nm, const std::vector<double>& kernel) {
    constexpr int kSweeps = 100;
    constexpr double kReach = 8.0;  // in widths, where the product of two nodes is 1e-7
    std::vector<double> weights(nodes.size(), 0.0);
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            double rest = kernel[i];
            for (std::size_t j = 0; j < nodes.size(); ++j) {
                const double z = (nodes[i] - nodes[j]) / width_nm;
                if (j != i && std::abs(z) < kReach) rest -= std::exp(-0.25 * z * z) * weights[j];
            }
            weights[i] = std::max(rest / (1.0 + kRidge), 0.0);
        }
    return weights;
}

}  // namespace

double element_sum(const glm::dmat3& matrix) {
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) sum += matrix[c][0] + matrix[c][1] + matrix[c][2];
    return sum;
}

void add_segments(const KernelRaster& raster, double distance_nm, std::vector<StreakSegment>& segments) {
    double whole = 0.0;
    for (const glm::dmat3& sum : raster.sums) whole += element_sum(sum);
    if (!(whole > 0.0)) return;
    double below = 0.0;
    std::size_t first = raster.sums.size();
    std::size_t last = 0;
    for (std::size_t i = 0; i < raster.sums.size(); ++i) {
        below += element_sum(raster.sums[i]);
        if (below >= kBeyondNodes * whole) first = std::min(first, i);
        if (below <= (1.0 - kBeyondNodes) * whole) last = i;
    }
    const double begin = raster.middle_nm(first);
    const double extent = raster.middle_nm(std::max(first, last)) - begin;
    const int count = std::max(1, static_cast<int>(std::lround((extent / distance_nm + 1.0) / kSegmentNodes)));
    const double step = extent / (count * kSegmentNodes - 1);
    for (int i = 0; i < count; ++i)
        segments.push_back({.first_nm = static_cast<float>(begin + i * kSegmentNodes * step),
                            .step_nm = static_cast<float>(step),
                            .weights = {}});
}

void fit_weights(std::span<const KernelRaster> rasters, double width_nm, std::vector<StreakSegment>& segments) {
    std::vector<double> nodes;
    for (const StreakSegment& segment : segments)
        for (int j = 0; j < kSegmentNodes; ++j) nodes.push_back(segment.path_nm(j));
    for (int e = 0; e < 9; ++e) {
        std::vector<double> kernel(nodes.size(), 0.0);
        double whole = 0.0;
        for (const KernelRaster& raster : rasters)
            for (std::size_t k = 0; k < raster.sums.size(); ++k) {
                const double part = raster.sums[k][e / 3][e % 3];
                whole += part;
                for (std::size_t i = 0; i < nodes.size(); ++i) {
                    const double z = (raster.middle_nm(k) - nodes[i]) / width_nm;
                    if (std::abs(z) < 6.0) kernel[i] += std::numbers::sqrt2 * std::exp(-0.5 * z * z) * part;
                }
            }
        const std::vector<double> weights = fit_element(nodes, width_nm, kernel);
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        for (std::size_t i = 0; i < nodes.size() && sum > 0.0; ++i)  // even light is exact
            segments[i / kSegmentNodes].weights[i % kSegmentNodes][e / 3][e % 3] =
                static_cast<float>(weights[i] * whole / sum);
    }
}

}  // namespace rowland::diffraction
