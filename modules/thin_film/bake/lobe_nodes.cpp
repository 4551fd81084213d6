#include "modules/thin_film/bake/lobe_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <span>

#include "engine/core/parallel.h"
#include "modules/thin_film/bake/film_table.h"
#include "modules/thin_film/bake/lobe_angles.h"

namespace rowland::thin_film {

namespace {

/// The rule is exact for polynomials of degree 7 in cos^0.7: of the powers .5 to .9 the one with the least error over
/// six films. PHYSICS §5.
constexpr double kPower = 0.7;

/// Of narrower lobes only the width differs, in proportion to roughness².
constexpr double kNarrowestRoughness = 0.04;

/// The monic polynomials that are orthogonal over weighted points: p_{k+1} = (x − mean_k) p_k − ratio_k p_{k−1}.
struct Orthogonal {
    std::array<double, kLobeNodes> mean{};
    std::array<double, kLobeNodes> ratio{};
    std::array<double, kLobeNodes> norm{};  ///< Σ weight p_k²

    /// p_0 to p_degree.
    std::array<double, kLobeNodes + 1> values(double x, int degree) const {
        std::array<double, kLobeNodes + 1> p{1.0};
        for (std::size_t k = 0; k < static_cast<std::size_t>(degree); ++k)
            p.at(k + 1) = (x - mean.at(k)) * p.at(k) - (k > 0 ? ratio.at(k) * p.at(k - 1) : 0.0);
        return p;
    }
};

struct Point {
    double x;
    double weight;
};

/// Stieltjes' procedure.
Orthogonal orthogonal_over(std::span<const Point> points) {
    Orthogonal result;
    for (int degree = 0; degree < kLobeNodes; ++degree) {
        const auto k = static_cast<std::size_t>(degree);
        double norm = 0.0;
        double moment = 0.0;
        for (const Point& point : points) {
            const double p = result.values(point.x, degree).at(k);
            norm += point.weight * p * p;
            moment += point.weight * point.x * p * p;
        }
        result.norm.at(k) = norm;
        result.mean.at(k) = moment / norm;
        result.ratio.at(k) = k > 0 ? norm / result.norm.at(k - 1) : 0.0;
    }
    return result;
}

/// The zeros of p_kLobeNodes. Those of each polynomial lie between those of the next.
std::array<double, kLobeNodes> zeros(const Orthogonal& polynomials, double least, double greatest) {
    std::vector<double> bounds = {least, greatest};
    for (int degree = 1; degree <= kLobeNodes; ++degree) {
        std::vector<double> next = {least};
        for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
            double below = bounds[i];
            double above = bounds[i + 1];
            const auto p = [&](double x) { return polynomials.values(x, degree).at(static_cast<std::size_t>(degree)); };
            const bool rises = p(above) > p(below);
            for (int halving = 0; halving < 60; ++halving) {
                const double middle = 0.5 * (below + above);
                ((p(middle) > 0.0) == rises ? above : below) = middle;
            }
            next.push_back(0.5 * (below + above));
        }
        next.push_back(greatest);
        bounds = std::move(next);
    }
    std::array<double, kLobeNodes> result{};
    std::copy(bounds.begin() + 1, bounds.end() - 1, result.begin());
    return result;
}

double root_of(double cosine) {
    return std::sqrt(cosine + FilmTable::kCosineOffset);
}

double view_cosine_of(int column) {
    const double x = static_cast<double>(column) / (LobeNodeTable::kColumns - 1);
    double below = 0.0;
    double above = 1.0;
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (below + above);
        (lobe_column(middle) < x ? below : above) = middle;
    }
    return 0.5 * (below + above);
}

}  // namespace

double lobe_column(double view_cosine) {
    const double root = (root_of(view_cosine) - root_of(0.0)) / (root_of(1.0) - root_of(0.0));
    return 0.5 * (root + 1.0 - std::sqrt(1.0 - view_cosine));
}

std::array<LobeNode, kLobeNodes> lobe_nodes(double view_cosine, double roughness) {
    std::vector<Point> points;
    double sum = 0.0;
    double least = std::numeric_limits<double>::max();
    double greatest = 0.0;
    sample_lobe(view_cosine, std::max(roughness, kNarrowestRoughness), [&](double cosine, double weight) {
        points.push_back({std::pow(cosine, kPower), weight});
        sum += weight;
        least = std::min(least, points.back().x);
        greatest = std::max(greatest, points.back().x);
    });
    for (Point& point : points) point.weight /= sum;
    const Orthogonal polynomials = orthogonal_over(points);
    const std::array<double, kLobeNodes> x = zeros(polynomials, least, greatest);
    std::array<LobeNode, kLobeNodes> nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::array<double, kLobeNodes + 1> p = polynomials.values(x.at(i), kLobeNodes - 1);
        double inverse_weight = 0.0;
        for (std::size_t k = 0; k < nodes.size(); ++k) inverse_weight += p.at(k) * p.at(k) / polynomials.norm.at(k);
        const double cosine = std::pow(x.at(i), 1.0 / kPower);
        nodes.at(i) = {root_of(std::clamp(cosine, 0.0, 1.0)), 1.0 / inverse_weight};
    }
    return nodes;
}

std::array<LobeNode, kLobeNodes> LobeNodeTable::at(double view_cosine, double roughness) const {
    const double x = lobe_column(std::clamp(view_cosine, 0.0, 1.0)) * (kColumns - 1);
    const double y = std::sqrt(std::clamp(roughness, 0.0, 1.0)) * (kRows - 1);
    const int column = std::min(static_cast<int>(x), kColumns - 2);
    const int row = std::min(static_cast<int>(y), kRows - 2);
    const auto interpolated = [&](int plane) {
        const auto texel = [&](int c, int r) {
            return glm::dvec4(texels.at(static_cast<std::size_t>((plane * kRows + r) * kColumns + c)));
        };
        const auto in_row = [&](int r) { return glm::mix(texel(column, r), texel(column + 1, r), x - column); };
        return glm::mix(in_row(row), in_row(row + 1), y - row);
    };
    const glm::dvec4 roots = interpolated(0);
    const glm::dvec4 weights = interpolated(1);
    const double root = root_of(std::clamp(view_cosine, 0.0, 1.0));
    std::array<LobeNode, kLobeNodes> nodes;
    for (int i = 0; i < kLobeNodes; ++i)
        nodes.at(static_cast<std::size_t>(i)) = {root + roughness * roughness * roots[i], weights[i]};
    return nodes;
}

LobeNodeTable bake_lobe_nodes() {
    constexpr std::size_t kTexels = std::size_t{LobeNodeTable::kColumns} * LobeNodeTable::kRows;
    LobeNodeTable table{.texels = std::vector<glm::vec4>(2 * kTexels)};
    parallel_for(kTexels, [&](std::size_t i) {
        const auto column = static_cast<int>(i % LobeNodeTable::kColumns);
        const double row = static_cast<double>(i / LobeNodeTable::kColumns);
        const double roughness = std::max(std::pow(row / (LobeNodeTable::kRows - 1), 2.0), kNarrowestRoughness);
        const double cosine = view_cosine_of(column);
        const auto nodes = lobe_nodes(cosine, roughness);
        for (int k = 0; k < kLobeNodes; ++k) {
            const LobeNode& node = nodes.at(static_cast<std::size_t>(k));
            table.texels[i][k] = static_cast<float>((node.root - root_of(cosine)) / (roughness * roughness));
            table.texels[kTexels + i][k] = static_cast<float>(node.weight);
        }
    });
    return table;
}

}  // namespace rowland::thin_film
