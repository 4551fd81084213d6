#include "engine/lighting/light_metric.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/glm.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/environment_map.h"
#include "engine/math/spherical_harmonics.h"

namespace rowland::lighting {

namespace {

using Node = CubeTree::Node;

float luminance(const glm::vec3& rgb) {
    return glm::dot(rgb, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

std::size_t node_index(int side, int face, int column, int row) {
    const auto n = static_cast<std::size_t>(side);
    return (static_cast<std::size_t>(face) * n + static_cast<std::size_t>(row)) * n + static_cast<std::size_t>(column);
}

/// Leaves without light.
std::vector<Node> make_leaves(int side, std::size_t count) {
    ROWLAND_CHECK(std::has_single_bit(static_cast<unsigned>(side)) && side >= CubeTree::kRootSide,
                  "a cube tree's faces are powers of two of at least four texels");
    ROWLAND_CHECK_OP(count, ==, std::size_t{6} * static_cast<std::size_t>(side * side));
    std::vector<Node> leaves(count);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const double solid_angle = cube_solid_angle(side, column, row);
            for (int face = 0; face < 6; ++face) {
                const std::size_t i = node_index(side, face, column, row);
                Node& leaf = leaves[i];
                leaf.solid_angle = static_cast<float>(solid_angle);
                leaf.size = static_cast<float>(std::sqrt(solid_angle));
                leaf.centre = glm::vec3(
                    glm::normalize(cube_direction(face, (2 * column + 1.0) / side - 1, (2 * row + 1.0) / side - 1)));
                leaf.source = leaf.centre;
            }
        }
    return leaves;
}

Node join(const Node* const (&children)[4]) {
    Node node;
    glm::vec3 source(0.0f);
    glm::vec3 centre(0.0f);
    for (const Node* child : children) {
        node.flux += child->flux;
        node.solid_angle += child->solid_angle;
        source += luminance(child->flux) * child->source;
        centre += child->solid_angle * child->centre;
    }
    node.size = std::sqrt(node.solid_angle);
    node.centre = glm::normalize(centre);
    const float length = glm::length(source);
    node.source = length > 0 && std::isfinite(length) ? source / length : node.centre;
    return node;
}

}  // namespace

CubeTree::CubeTree(std::span<const glm::vec3> texels, int face_size) {
    std::vector<Node> leaves = make_leaves(face_size, texels.size());
    for (std::size_t i = 0; i < leaves.size(); ++i) leaves[i].flux = texels[i] * leaves[i].solid_angle;
    join_levels(std::move(leaves), face_size);
}

CubeTree::CubeTree(std::span<const CubeCell> cells, int face_size) {
    std::vector<Node> leaves = make_leaves(face_size, cells.size());
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        leaves[i].flux = glm::vec3(cells[i].flux);
        if (const glm::dvec3 sum = cells[i].direction_sum; sum != glm::dvec3(0.0))
            leaves[i].source = glm::vec3(glm::normalize(sum));
    }
    join_levels(std::move(leaves), face_size);
}

void CubeTree::join_levels(std::vector<Node> leaves, int face_size) {
    levels_.push_back(std::move(leaves));
    for (int side = face_size / 2; side >= kRootSide; side /= 2) {
        const std::vector<Node>& finer = levels_.back();
        std::vector<Node> level(finer.size() / 4);
        for (int face = 0; face < 6; ++face)
            for (int row = 0; row < side; ++row)
                for (int column = 0; column < side; ++column) {
                    const auto child = [&](int i, int j) {
                        return &finer[node_index(2 * side, face, 2 * column + i, 2 * row + j)];
                    };
                    level[node_index(side, face, column, row)] =
                        join({child(0, 0), child(1, 0), child(0, 1), child(1, 1)});
                }
        levels_.push_back(std::move(level));
    }
    std::reverse(levels_.begin(), levels_.end());
}

namespace {

/// Cells per side of a cube face, for normals and for directions.
constexpr int kNormalSide = 6;
constexpr int kWeightSide = 32;
constexpr std::size_t kCorners = kWeightSide + 1;

/// Added to the squared signal of every surface, as a fraction of the mean, so that none is 0.
constexpr double kLeastSignal = 4e-4;

struct WeightedNormal {
    glm::dvec3 normal;
    double weight;  ///< of max(0, n·s)²
};

double clamped_square(const glm::dvec3& normal, const glm::dvec3& s) {
    const double cosine = std::max(0.0, glm::dot(normal, s));
    return cosine * cosine;
}

std::vector<WeightedNormal> weighted_normals(std::span<const DirectionWeight::Signal> signals) {
    std::vector<WeightedNormal> result;
    std::vector<double> squares;
    double mean = 0.0;
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < kNormalSide; ++row)
            for (int column = 0; column < kNormalSide; ++column) {
                const glm::dvec3 normal = glm::normalize(
                    cube_direction(face, (2 * column + 1.0) / kNormalSide - 1, (2 * row + 1.0) / kNormalSide - 1));
                const double up = 0.5 + 0.5 * normal.y;
                result.push_back({normal, up * up * cube_solid_angle(kNormalSide, column, row)});
                double square = 0.0;
                for (const DirectionWeight::Signal& signal : signals)
                    square += clamped_square(normal, signal.direction) * signal.square;
                squares.push_back(square);
                mean += square / (6 * kNormalSide * kNormalSide);
            }
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double square = std::max(0.0, squares[i]) + kLeastSignal * mean;
        result[i].weight /= square > 0.0 ? square : 1.0;
    }
    return result;
}

}  // namespace

DirectionWeight::DirectionWeight(std::span<const Signal> signals) {
    const std::vector<WeightedNormal> normals = weighted_normals(signals);
    double mean = 0.0;
    for (int face = 0; face < 6; ++face)
        for (std::size_t row = 0; row < kCorners; ++row)
            for (std::size_t column = 0; column < kCorners; ++column) {
                const glm::dvec3 s =
                    glm::normalize(cube_direction(face, 2.0 * static_cast<double>(column) / kWeightSide - 1,
                                                  2.0 * static_cast<double>(row) / kWeightSide - 1));
                double weight = 0.0;
                for (const auto& [normal, of_normal] : normals) weight += of_normal * clamped_square(normal, s);
                roots_.push_back(std::sqrt(weight));
                mean += roots_.back() / (6.0 * kCorners * kCorners);
            }
    for (double& root : roots_) root /= mean;
}

double DirectionWeight::root(const glm::dvec3& direction) const {
    const CubePoint at = cube_point(direction);
    const double x = std::clamp(0.5 * (at.s + 1.0), 0.0, 1.0) * kWeightSide;
    const double y = std::clamp(0.5 * (at.t + 1.0), 0.0, 1.0) * kWeightSide;
    const int column = std::min(static_cast<int>(x), kWeightSide - 1);
    const int row = std::min(static_cast<int>(y), kWeightSide - 1);
    const double* corner =
        &roots_[(static_cast<std::size_t>(at.face) * kCorners + static_cast<std::size_t>(row)) * kCorners +
                static_cast<std::size_t>(column)];
    const double along = x - column;
    return std::lerp(std::lerp(corner[0], corner[1], along), std::lerp(corner[kCorners], corner[kCorners + 1], along),
                     y - row);
}

namespace {

// An arc of a grating integrates light along a circle, so that over all arcs the square of band l counts by about 1/l.
// Smoothing by a lobe of variance v multiplies it by exp(−l² v/2), and Σ √v exp(−l² v/2) is about 1/l over these
// scales: from the finest detail that counts to the exact bands.
constexpr double kScaleRatio = 4.0;

/// A node is subdivided until its size is below this fraction of a scale's deviation. At a distance of d deviations,
/// where light contributes less, the limit is 1 + d²/kFarther times as large.
constexpr double kOpening = 1.0 / 4.0;
constexpr float kFarther = 4.0F;

/// Contributions below exp(−this) of the peak are omitted.
constexpr double kMetricReach = 12.0;

/// The weight varies slowly: the weighted light of n exact bands lies in n + kFurtherBands bands.
constexpr int kFurtherBands = 3;

/// Nodes per side of the cube faces on which the low bands and the signals are summed: .05 and .1 rad.
constexpr int kLowBandSide = 32;
constexpr int kSignalSide = 16;

int depth_of(const CubeTree& tree, int side) {
    int depth = 0;
    while (depth < tree.leaf_depth() && tree.side(depth) < side) ++depth;
    return depth;
}

/// Calls function(node) for all nodes of a depth.
template <typename Function>
void for_each_node(const CubeTree& tree, int depth, const Function& function) {
    const int side = tree.side(depth);
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) function(tree.node(depth, face, column, row));
}

/// Sum of the light of a tree, weighted by exp(concentration (cosine − 1)) about an axis.
struct TreeSum {
    const CubeTree& tree;
    glm::vec3 axis{0.0F};
    float concentration = 0.0F;
    float reach = 0.0F;  ///< longest chord from the axis to light that is counted
    float open = 0.0F;   ///< size of the largest node on the axis that is not opened
    glm::dvec3 sum{0.0};

    void add(int depth, int face, int column, int row) {
        const CubeTree::Node& node = tree.node(depth, face, column, row);
        const glm::vec3 chord = node.source - axis;
        const float square = glm::dot(chord, chord);
        const bool opened = depth < tree.leaf_depth() && node.size > open * (1.0F + concentration * square / kFarther);
        // The light of a node is no farther from its centroid than a diagonal of the most stretched cell.
        const float within = reach + (opened ? 1.7F * node.size : 0.0F);
        if (square > within * within) return;
        if (!opened) {
            // In double: last bits of a float, which differ between C libraries, would be 1e-6 of a flux that is
            // fitted.
            sum += std::exp(static_cast<double>(-0.5F * concentration * square)) * glm::dvec3(node.flux);
            return;
        }
        for (int i = 0; i < 4; ++i) add(depth + 1, face, 2 * column + i % 2, 2 * row + i / 2);
    }
};

/// LobeProduct of a lobe and all light of a tree.
glm::dvec3 product_with(const CubeTree& tree, const LobeShape& lobe, const KeyLightFit& settings) {
    const LobeProduct product(1.0 / lobe.concentration, settings);
    glm::dvec3 result(0.0);
    for (const LobeProduct::Scale& scale : product.scales()) {
        const double deviation = 1.0 / std::sqrt(scale.concentration);
        TreeSum light{.tree = tree,
                      .axis = glm::vec3(lobe.direction),
                      .concentration = static_cast<float>(scale.concentration),
                      .reach = static_cast<float>(std::sqrt(2.0 * kMetricReach) * deviation),
                      .open = static_cast<float>(kOpening * deviation)};
        for (int face = 0; face < 6; ++face)
            for (int row = 0; row < CubeTree::kRootSide; ++row)
                for (int column = 0; column < CubeTree::kRootSide; ++column) light.add(0, face, column, row);
        result += scale.peak * light.sum;
    }
    return result;
}

/// The weight for the light of a tree. Each node is a signal: its square is the node's flux times the light that is
/// smoothed by LobeProduct in its direction.
DirectionWeight weight_of(const CubeTree& light, const KeyLightFit& settings) {
    std::vector<const CubeTree::Node*> nodes;
    for_each_node(light, depth_of(light, kSignalSide), [&](const CubeTree::Node& node) { nodes.push_back(&node); });
    std::vector<DirectionWeight::Signal> signals(nodes.size());
    parallel_for(nodes.size(), [&](std::size_t i) {
        const glm::dvec3 direction = glm::normalize(glm::dvec3(nodes[i]->source));
        const glm::dvec3 flux(nodes[i]->flux);
        if (flux == glm::dvec3(0.0)) return;
        signals[i] = {direction, glm::dot(flux, product_with(light, {direction, kNarrowestConcentration}, settings))};
    });
    return DirectionWeight(signals);
}

CubeTree weighted_tree(std::span<const CubeCell> cells, int face_size, const DirectionWeight& weight) {
    std::vector<CubeCell> weighted(cells.begin(), cells.end());
    for (CubeCell& cell : weighted)
        if (cell.direction_sum != glm::dvec3(0.0)) cell.flux *= weight.root(glm::normalize(cell.direction_sum));
    return {weighted, face_size};
}

/// Square roots of the coefficients' weights, by band.
Eigen::VectorXd band_roots(int bands, const KeyLightFit& settings) {
    std::vector<double> weights(static_cast<std::size_t>(bands), 0.0);
    double smoothed = 2.0 / settings.smoothing;
    for (int i = 0; i < LobeProduct::kScales; ++i, smoothed *= kScaleRatio) {
        const std::vector<double> factors = lobe_band_factors(1.0 / smoothed, bands);
        for (std::size_t l = 0; l < weights.size(); ++l) weights[l] += std::sqrt(smoothed) * factors[l];
    }
    Eigen::VectorXd roots(math::sh_count(bands));
    for (int l = 0; l < bands; ++l)
        for (int m = -l; m <= l; ++m) roots[math::sh_index(l, m)] = std::sqrt(weights[static_cast<std::size_t>(l)]);
    return roots;
}

Eigen::VectorXd sh_at(const glm::dvec3& direction, int bands) {
    Eigen::VectorXd values(math::sh_count(bands));
    math::evaluate_sh(direction, bands, {values.data(), static_cast<std::size_t>(values.size())});
    return values;
}

}  // namespace

LobeProduct::LobeProduct(double variance, const KeyLightFit& settings) {
    double smoothed = 2.0 / settings.smoothing;  // both factors are smoothed
    for (Scale& scale : scales_) {
        scale.concentration = 1.0 / (smoothed + variance);
        const double density = scale.concentration / (-2.0 * std::numbers::pi * std::expm1(-2.0 * scale.concentration));
        scale.peak = std::sqrt(smoothed) * density;
        smoothed *= kScaleRatio;
    }
}

double LobeProduct::operator()(double cosine) const {
    double product = 0.0;
    for (const Scale& scale : scales_) product += scale.peak * std::exp(scale.concentration * (cosine - 1.0));
    return product;
}

double inner_product(const MeasuredLobe& a, const MeasuredLobe& b, const LobeProduct& product) {
    return a.root * b.root * product(glm::dot(a.shape.direction, b.shape.direction)) - a.bands.dot(b.bands) +
           a.error.dot(b.error);
}

MeasuredProbe::MeasuredProbe(std::span<const CubeCell> cells, int face_size, const KeyLightFit& settings)
    : MeasuredProbe(cells, face_size, CubeTree(cells, face_size), settings) {}

MeasuredProbe::MeasuredProbe(std::span<const CubeCell> cells, int face_size, const CubeTree& light,
                             const KeyLightFit& settings)
    : settings_(settings),
      low_bands_(std::min(settings.exact_bands + kFurtherBands, math::kMaximumBands)),
      weight_(weight_of(light, settings)),
      tree_(weighted_tree(cells, face_size, weight_)),
      band_roots_(band_roots(low_bands_, settings)) {
    add_low_bands(light);
}

void MeasuredProbe::add_low_bands(const CubeTree& light) {
    const Eigen::Index exact = math::sh_count(settings_.exact_bands);
    const Eigen::Index low = math::sh_count(low_bands_);
    shown_ = Eigen::MatrixXd::Zero(low, exact);
    bands_ = Eigen::MatrixX3d::Zero(low, 3);
    Eigen::MatrixX3d plain = Eigen::MatrixX3d::Zero(exact, 3);
    for_each_node(light, depth_of(light, kLowBandSide), [&](const CubeTree::Node& node) {
        const glm::dvec3 source = glm::normalize(glm::dvec3(node.source));
        const Eigen::VectorXd at_light = sh_at(source, low_bands_);
        const Eigen::RowVector3d flux(node.flux.x, node.flux.y, node.flux.z);
        plain += at_light.head(exact) * flux;
        bands_ += weight_.root(source) * at_light * flux;
        const glm::dvec3 centre = glm::normalize(glm::dvec3(node.centre));
        const Eigen::VectorXd at_centre = sh_at(centre, low_bands_);
        shown_ += weight_.root(centre) * static_cast<double>(node.solid_angle) * at_centre *
                  at_centre.head(exact).transpose();
    });
    error_ = bands_ - shown_.lazyProduct(plain);
    bands_ = band_roots_.asDiagonal() * bands_;
    error_ = band_roots_.asDiagonal() * error_;
}

MeasuredLobe MeasuredProbe::measure(const LobeShape& lobe) const {
    MeasuredLobe measured{.shape = lobe, .root = weight_.root(lobe.direction), .bands = {}, .error = {}};
    Eigen::VectorXd light = sh_at(lobe.direction, low_bands_);
    const std::vector<double> factors = lobe_band_factors(lobe.concentration, low_bands_);
    for (int l = 0; l < low_bands_; ++l)
        light.segment(math::sh_index(l, -l), 2 * l + 1) *= factors[static_cast<std::size_t>(l)];
    measured.bands = measured.root * light;
    measured.error = measured.bands - shown_ * light.head(shown_.cols());
    measured.bands.array() *= band_roots_.array();
    measured.error.array() *= band_roots_.array();
    return measured;
}

glm::dvec3 MeasuredProbe::with(const MeasuredLobe& lobe) const {
    const Eigen::RowVector3d low = lobe.error.transpose() * error_ - lobe.bands.transpose() * bands_;
    return lobe.root * product_with(tree_, lobe.shape, settings_) + glm::dvec3(low[0], low[1], low[2]);
}

}  // namespace rowland::lighting
