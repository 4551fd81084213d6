#include "editor/lobe_nodes/gauss_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace rowland::lighting {

namespace {

/// Of the powers .5 to .9, this one has the least error over six thin films.
constexpr double kPower = 0.7;

struct Point {
    double x;
    double weight;
};

/// By Stieltjes' procedure.
LobePolynomials orthogonal_over(std::span<const Point> points) {
    LobePolynomials result;
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

/// The zeros of p_kLobeNodes, by bisection: the zeros of p_k separate those of p_{k+1}.
std::array<double, kLobeNodes> zeros(const LobePolynomials& polynomials) {
    std::vector<double> bounds = {polynomials.least, polynomials.greatest};
    for (int degree = 1; degree <= kLobeNodes; ++degree) {
        std::vector<double> next = {polynomials.least};
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
        next.push_back(polynomials.greatest);
        bounds = std::move(next);
    }
    std::array<double, kLobeNodes> result{};
    std::copy(bounds.begin() + 1, bounds.end() - 1, result.begin());
    return result;
}

}  // namespace

double lobe_coordinate(double cosine) {
    return std::pow(cosine, kPower);
}

LobePolynomials lobe_polynomials(double view_cosine, double roughness) {
    std::vector<Point> points;
    double sum = 0.0;
    double least = std::numeric_limits<double>::max();
    double greatest = 0.0;
    sample_lobe(view_cosine, std::max(roughness, kNarrowestRoughness), [&](double cosine, double weight) {
        points.push_back({lobe_coordinate(cosine), weight});
        sum += weight;
        least = std::min(least, points.back().x);
        greatest = std::max(greatest, points.back().x);
    });
    for (Point& point : points) point.weight /= sum;
    LobePolynomials polynomials = orthogonal_over(points);
    polynomials.least = least;
    polynomials.greatest = greatest;
    return polynomials;
}

LobeNodes gauss_nodes(double view_cosine, double roughness) {
    const LobePolynomials polynomials = lobe_polynomials(view_cosine, roughness);
    const std::array<double, kLobeNodes> x = zeros(polynomials);
    LobeNodes nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::array<double, kLobeNodes + 1> p = polynomials.values(x.at(i), kLobeNodes - 1);
        double inverse_weight = 0.0;
        for (std::size_t k = 0; k < nodes.size(); ++k) inverse_weight += p.at(k) * p.at(k) / polynomials.norm.at(k);
        nodes.at(i) = {.cosine = std::clamp(std::pow(x.at(i), 1.0 / kPower), 0.0, 1.0),
                       .weight = 1.0 / inverse_weight,
                       .lean = 0.0,
                       .roughness = roughness};
    }
    return nodes;
}

double column_view_cosine(int column) {
    const double position = static_cast<double>(column) / (LobeNodeTable::kColumns - 1);
    double below = 0.0;
    double above = 1.0;
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (below + above);
        (lobe_column(middle) < position ? below : above) = middle;
    }
    return 0.5 * (below + above);
}

double row_roughness(int row) {
    return std::max(std::pow(static_cast<double>(row) / (LobeNodeTable::kRows - 1), 2.0), kNarrowestRoughness);
}

LobeNodes texel_nodes(const LobeNodeTable& table, int column, int row) {
    LobeNodeTable::Planes planes;
    for (int plane = 0; plane < LobeNodeTable::kPlanes; ++plane)
        planes.at(static_cast<std::size_t>(plane)) = table.texels.at(LobeNodeTable::index(plane, column, row));
    return LobeNodeTable::nodes_of(planes, column_view_cosine(column), row_roughness(row));
}

void set_texel(LobeNodeTable& table, int column, int row, const LobeNodes& nodes) {
    const double square = row_roughness(row) * row_roughness(row);
    const double view_root = std::sqrt(column_view_cosine(column) + kLobeCosineOffset);
    for (int i = 0; i < kLobeNodes; ++i) {
        const LobeNode& node = nodes.at(static_cast<std::size_t>(i));
        const std::array<double, LobeNodeTable::kPlanes> values = {
            (std::sqrt(node.cosine + kLobeCosineOffset) - view_root) / square, node.weight, node.lean / square,
            node.roughness / row_roughness(row)};
        for (int plane = 0; plane < LobeNodeTable::kPlanes; ++plane)
            table.texels.at(LobeNodeTable::index(plane, column, row))[i] =
                static_cast<float>(values.at(static_cast<std::size_t>(plane)));
    }
}

}  // namespace rowland::lighting
