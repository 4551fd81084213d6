#include "engine/lighting/light_metric.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "engine/math/sh_basis.h"

namespace rowland::lighting {

namespace {

// An arc of a grating integrates light along a circle, so that over all arcs the square of band l counts by about 1/l.
// Smoothing by a lobe of variance v multiplies it by exp(−l² v/2), and Σ √v exp(−l² v/2) is about 1/l over these
// scales: from the finest detail that counts to the exact bands.
constexpr int kScales = 4;
constexpr double kScaleRatio = 4.0;

/// Nodes of a tree are opened until they are smaller than this fraction of a scale's deviation.
constexpr double kOpening = 1.0 / 3.0;

/// exp(−this) of a peak is left out of sums.
constexpr double kMetricReach = 12.0;

/// Nodes that low bands are summed in: cells of .025 rad.
constexpr int kLowBandSide = 64;

}  // namespace

LobeProduct::LobeProduct(double variance, const KeyLightFit& settings)
    : band_factors_(static_cast<std::size_t>(settings.exact_bands), 0.0) {
    const glm::dvec3 pole(0.0, 1.0, 0.0);
    double smoothed = 2.0 / settings.smoothing;  // both factors are smoothed
    for (int i = 0; i < kScales; ++i) {
        const double weight = std::sqrt(smoothed);
        const double concentration = 1.0 / (smoothed + variance);
        scales_.push_back({concentration, weight * lobe_density({pole, glm::dvec3(1.0), concentration}, pole)});
        if (!band_factors_.empty()) {
            const std::vector<double> factors = lobe_band_factors(concentration, settings.exact_bands);
            for (std::size_t l = 0; l < factors.size(); ++l) band_factors_[l] += weight * factors[l];
        }
        smoothed *= kScaleRatio;
    }
}

double LobeProduct::operator()(double cosine) const {
    double product = 0.0;
    for (const Scale& scale : scales_) product += scale.peak * std::exp(scale.concentration * (cosine - 1.0));
    double before = 0.0;
    double legendre = 1.0;
    for (int l = 0; l < static_cast<int>(band_factors_.size()); ++l) {
        product -= (2 * l + 1) / (4.0 * std::numbers::pi) * band_factors_[static_cast<std::size_t>(l)] * legendre;
        const double next = ((2 * l + 1) * cosine * legendre - l * before) / (l + 1);
        before = legendre;
        legendre = next;
    }
    return product;
}

double inner_product(const LobeShape& a, const LobeShape& b, const KeyLightFit& settings) {
    return LobeProduct(1.0 / a.concentration + 1.0 / b.concentration, settings)(glm::dot(a.direction, b.direction));
}

/// A sum over the tree: exp(concentration (cosine − 1)) about an axis.
struct MeasuredProbe::Query {
    glm::vec3 axis{0.0F};
    float concentration = 0.0F;
    float reach = 0.0F;  ///< chord
    float open = 0.0F;   ///< size of the largest node that is not opened
};

MeasuredProbe::MeasuredProbe(CubeTree tree, const KeyLightFit& settings)
    : tree_(std::move(tree)),
      settings_(settings),
      low_(static_cast<std::size_t>(math::sh_count(settings.exact_bands)), glm::dvec3(0.0)) {
    int depth = 0;
    while (depth < tree_.leaf_depth() && tree_.side(depth) < kLowBandSide) ++depth;
    const int side = tree_.side(depth);
    std::vector<double> basis(low_.size());
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                const CubeTree::Node& node = tree_.node(depth, face, column, row);
                math::evaluate_sh(glm::normalize(glm::dvec3(node.source)), settings.exact_bands, basis);
                for (std::size_t k = 0; k < basis.size(); ++k) low_[k] += basis[k] * glm::dvec3(node.flux);
            }
}

void MeasuredProbe::add_node(const Query& query, int depth, int face, int column, int row, glm::dvec3& sum) const {
    const CubeTree::Node& node = tree_.node(depth, face, column, row);
    const bool open = depth < tree_.leaf_depth() && node.size > query.open;
    const glm::vec3 chord = node.source - query.axis;
    const float square = glm::dot(chord, chord);
    // Light of a node is at most a diagonal of a stretched cell from its centroid.
    const float reach = query.reach + (open ? 1.7F * node.size : 0.0F);
    if (square > reach * reach) return;
    if (!open) {
        sum += static_cast<double>(std::exp(-0.5F * query.concentration * square)) * glm::dvec3(node.flux);
        return;
    }
    for (int i = 0; i < 4; ++i) add_node(query, depth + 1, face, 2 * column + i % 2, 2 * row + i / 2, sum);
}

glm::dvec3 MeasuredProbe::with(const LobeShape& lobe) const {
    const LobeProduct product(1.0 / lobe.concentration, settings_);
    glm::dvec3 sum(0.0);
    for (const LobeProduct::Scale& scale : product.scales()) {
        const double deviation = 1.0 / std::sqrt(scale.concentration);
        const Query query{.axis = glm::vec3(lobe.direction),
                          .concentration = static_cast<float>(scale.concentration),
                          .reach = static_cast<float>(std::sqrt(2.0 * kMetricReach) * deviation),
                          .open = static_cast<float>(kOpening * deviation)};
        glm::dvec3 light(0.0);
        for (int face = 0; face < 6; ++face)
            for (int row = 0; row < CubeTree::kRootSide; ++row)
                for (int column = 0; column < CubeTree::kRootSide; ++column)
                    add_node(query, 0, face, column, row, light);
        sum += scale.peak * light;
    }
    std::vector<double> basis(low_.size());
    math::evaluate_sh(lobe.direction, settings_.exact_bands, basis);
    for (int l = 0; l < settings_.exact_bands; ++l)
        for (int m = -l; m <= l; ++m) {
            const auto k = static_cast<std::size_t>(math::sh_index(l, m));
            sum -= product.band_factors()[static_cast<std::size_t>(l)] * basis[k] * low_[k];
        }
    return sum;
}

}  // namespace rowland::lighting
