#include "editor/lobe_nodes/fit_lobe_nodes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "editor/lobe_nodes/gauss_nodes.h"
#include "engine/core/parallel.h"

namespace rowland::lighting {

namespace {

using std::numbers::pi;

/// Fitted functions: the lobe itself, and its products with polynomials of degrees 1 to 3.
constexpr int kProducts = 4;
/// Weight of a product relative to the lobe. With .5 the lobe of a white metal is worse, with 0 that of glass.
constexpr double kProductWeight = 0.25;
/// Strength of the regularisation: toward the mirror direction in the first fit, toward the mean of the neighbouring
/// texels in the sweeps. Near normal incidence leans have little effect, and nodes could exchange roles from one texel
/// to the next: the reflection of a lamp on a sphere would have edges.
constexpr double kMirrorStrength = 0.01;
constexpr double kNeighbourStrength = 0.3;
constexpr int kSweeps = 8;
/// The lean of each node, then the logarithm of each node's roughness relative to the surface's.
constexpr int kParameters = 2 * kLobeNodes;
using Parameters = Eigen::Matrix<double, kParameters, 1>;

constexpr double kLargestLean = 2.0;
constexpr double kLeastRatio = 0.2;
constexpr double kLargestRatio = 1.4;

/// Lobe of an EnvironmentMap level about its axis, 1/sr: D(h) cos θ with view = normal = axis, normalised.
class LevelLobe {
 public:
    explicit LevelLobe(double roughness) {
        const double alpha = std::clamp(roughness * roughness, 1e-5, 1.0 - 1e-6);
        slope_ = 0.5 * (alpha * alpha - 1.0);
        const double begin = 1.0 + slope_;
        const double end = begin + slope_;
        norm_ = slope_ * slope_ / (2.0 * pi * (std::log(end / begin) + begin / end - 1.0));
    }
    double operator()(double cosine) const {
        if (cosine <= 0.0) return 0.0;
        const double root = 1.0 + slope_ + slope_ * cosine;
        return norm_ * cosine / (root * root);
    }

 private:
    double slope_;
    double norm_;
};

/// GGX lobe of a surface for one view, importance-sampled by that lobe and by a wider one. The view is in the x-z
/// plane, the normal along z.
class Lobe {
 public:
    Lobe(double view_cosine, double roughness) : roughness_(roughness) {
        const double cosine = std::clamp(view_cosine, 1e-3, 1.0 - 1e-6);
        view_ = {std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
        polynomials_ = lobe_polynomials(cosine, roughness);
        const double alpha = roughness * roughness;
        const double wide = std::min(2.5 * alpha, 1.0);
        add_points(alpha, alpha, wide);
        add_points(wide, alpha, wide);
        double sum = 0.0;
        for (const Direction& point : points_) sum += point.lobe * point.weight;
        for (Direction& point : points_) {
            point.lobe /= sum;
            square_ += point.lobe * point.lobe * point.weight;
        }
    }

    /// Differences at every sample, product by product. Their squared norm is the squared misfit.
    Eigen::VectorXd residual(const Parameters& parameters, const LobeNodes& nodes) const {
        std::vector<LevelLobe> lobes;
        std::array<glm::dvec3, kLobeNodes> axes{};
        std::array<std::array<double, kProducts>, kLobeNodes> factors{};
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const auto k = static_cast<Eigen::Index>(i);
            lobes.emplace_back(std::min(roughness_ * std::exp(parameters[kLobeNodes + k]), 1.0));
            axes.at(i) = axis(parameters[k]);
            factors.at(i) = products(nodes.at(i).cosine);
        }
        Eigen::VectorXd result(static_cast<Eigen::Index>(points_.size() * kProducts));
        for (std::size_t p = 0; p < points_.size(); ++p) {
            const Direction& point = points_[p];
            std::array<double, kProducts> found{};
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                const double part = nodes.at(i).weight * lobes[i](glm::dot(point.direction, axes.at(i)));
                for (std::size_t k = 0; k < kProducts; ++k) found.at(k) += part * factors.at(i).at(k);
            }
            const double root = std::sqrt(point.weight / square_);
            for (std::size_t k = 0; k < kProducts; ++k)
                result[static_cast<Eigen::Index>(p * kProducts + k)] =
                    (k > 0 ? kProductWeight : 1.0) * root * (found.at(k) - point.lobe * point.products.at(k));
        }
        return result;
    }

    double roughness() const { return roughness_; }

 private:
    struct Direction {
        glm::dvec3 direction;
        double lobe;    ///< 1/sr; it integrates to 1
        double weight;  ///< sr
        std::array<double, kProducts> products;
    };

    glm::dvec3 axis(double lean) const {
        return glm::normalize((1.0 - lean) * glm::dvec3(-view_.x, 0.0, view_.z) + glm::dvec3(0.0, 0.0, lean));
    }

    /// The normalised polynomials at the angle of incidence on a microfacet.
    std::array<double, kProducts> products(double cosine) const {
        const auto p = polynomials_.values(lobe_coordinate(cosine), kProducts - 1);
        std::array<double, kProducts> result{};
        for (std::size_t k = 0; k < result.size(); ++k) result.at(k) = p.at(k) / std::sqrt(polynomials_.norm.at(k));
        return result;
    }

    /// GGX normal distribution.
    static double distribution(double cosine, double alpha) {
        const double root = cosine * cosine * (alpha * alpha - 1.0) + 1.0;
        return alpha * alpha / (pi * root * root);
    }
    static double smith_root(double cosine, double alpha) {
        return std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine);
    }
    /// Probability density of directions reflected by visible microfacets, 1/sr.
    double density(double half_cosine, double alpha) const {
        return distribution(half_cosine, alpha) / (2.0 * (view_.z + smith_root(view_.z, alpha)));
    }

    /// Adds directions that visible microfacets of roughness √`spread` reflect, for y ≥ 0 [Dupuy & Benyoub 2023].
    void add_points(double spread, double alpha, double wide) {
        constexpr int kCount = 600;
        const glm::dvec3 stretched = glm::normalize(glm::dvec3(spread * view_.x, 0.0, view_.z));
        for (int i = 0; i < kCount; ++i) {
            const double azimuth = pi * std::fmod(i * (std::numbers::phi - 1.0), 1.0);
            const double z = 1.0 - (i + 0.5) / kCount * (1.0 + stretched.z);
            const double side = std::sqrt(std::max(1.0 - z * z, 0.0));
            const glm::dvec3 cap = glm::dvec3(side * std::cos(azimuth), side * std::sin(azimuth), z) + stretched;
            const glm::dvec3 half = glm::normalize(glm::dvec3(spread * cap.x, spread * cap.y, cap.z));
            const double cosine = glm::dot(view_, half);
            const glm::dvec3 light = 2.0 * cosine * half - view_;
            // Look-up lobes should vanish below the horizon as well: sample as far as they reach.
            if (light.z < -0.3 || cosine <= 0.0) continue;
            double lobe = 0.0;
            if (light.z > 0.0)
                lobe = distribution(half.z, alpha) * light.z /
                       (2.0 * (light.z * smith_root(view_.z, alpha) + view_.z * smith_root(light.z, alpha)));
            points_.push_back({.direction = light,
                               .lobe = lobe,
                               .weight = 1.0 / (kCount * (density(half.z, alpha) + density(half.z, wide))),
                               .products = products(cosine)});
        }
    }

    double roughness_;
    glm::dvec3 view_{0.0};
    LobePolynomials polynomials_;
    std::vector<Direction> points_;
    double square_ = 0.0;
};

Parameters parameters_of(const LobeNodes& nodes, double roughness) {
    Parameters result;
    for (int i = 0; i < kLobeNodes; ++i) {
        const LobeNode& node = nodes.at(static_cast<std::size_t>(i));
        result[i] = std::clamp(node.lean, -kLargestLean, kLargestLean);
        result[kLobeNodes + i] = std::log(std::clamp(node.roughness / roughness, kLeastRatio, kLargestRatio));
    }
    return result;
}

LobeNodes with_parameters(LobeNodes nodes, const Parameters& parameters, double roughness) {
    for (int i = 0; i < kLobeNodes; ++i) {
        LobeNode& node = nodes.at(static_cast<std::size_t>(i));
        node.lean = parameters[i];
        node.roughness = roughness * std::exp(parameters[kLobeNodes + i]);
    }
    return nodes;
}

/// Levenberg–Marquardt with regularisation toward `centre`.
Parameters least_squares(const Lobe& lobe, const LobeNodes& nodes, const Parameters& start, const Parameters& centre,
                         double strength) {
    const double scale = std::max(lobe.roughness() * lobe.roughness(), 0.01);  // of leans
    Parameters unit = Parameters::Ones();
    unit.head<kLobeNodes>().setConstant(scale);
    const auto residual = [&](const Parameters& at) {
        const Eigen::VectorXd misfit = lobe.residual(at, nodes);
        Eigen::VectorXd result(misfit.size() + kParameters);
        result << misfit, strength * (at - centre).cwiseQuotient(unit);
        return result;
    };
    Parameters best = start;
    Eigen::VectorXd at_best = residual(best);
    double damping = 1e-2;
    for (int step = 0; step < 60; ++step) {
        Eigen::MatrixXd slopes(at_best.size(), kParameters);
        for (int i = 0; i < kParameters; ++i) {
            constexpr double kStep = 1e-4;
            Parameters moved = best;
            moved[i] += kStep * unit[i];
            slopes.col(i) = (residual(moved) - at_best) / (kStep * unit[i]);
        }
        const Eigen::MatrixXd normal = slopes.transpose() * slopes;
        const Eigen::VectorXd gradient = slopes.transpose() * at_best;
        bool improves = false;
        for (int attempt = 0; attempt < 8; ++attempt, damping *= 4.0) {
            Eigen::MatrixXd damped = normal;
            damped.diagonal() *= 1.0 + damping;
            Parameters next = best - damped.ldlt().solve(gradient);
            for (int i = 0; i < kLobeNodes; ++i) {
                next[i] = std::clamp(next[i], -kLargestLean, kLargestLean);
                next[kLobeNodes + i] = std::clamp(next[kLobeNodes + i], std::log(kLeastRatio), std::log(kLargestRatio));
            }
            const Eigen::VectorXd at_next = residual(next);
            const double before = at_best.squaredNorm();
            if (at_next.squaredNorm() >= before) continue;
            improves = before - at_next.squaredNorm() > 1e-5 * before;
            best = next;
            at_best = at_next;
            damping *= 0.3;
            break;
        }
        if (!improves) break;
    }
    return best;
}

/// Fits a texel, starting from a neighbour's nodes.
void fit_texel(int column, int row, int from_column, int from_row, LobeNodeTable& table) {
    const double view_cosine = column_view_cosine(column);
    const double roughness = row_roughness(row);
    const double before = row_roughness(from_row);
    const LobeNodes neighbour = texel_nodes(table, from_column, from_row);
    LobeNodes nodes = gauss_nodes(view_cosine, roughness);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        nodes.at(i).lean = neighbour.at(i).lean * std::pow(roughness / before, 2.0);
        nodes.at(i).roughness = neighbour.at(i).roughness * roughness / before;
    }
    set_texel(table, column, row, refine_nodes(view_cosine, roughness, nodes));
}

/// Mean of the neighbouring texels' parameters, scaled to this texel's roughness.
Parameters neighbour_mean(int column, int row, const LobeNodeTable& table) {
    const double roughness = row_roughness(row);
    Parameters sum = Parameters::Zero();
    int count = 0;
    const auto add = [&](int c, int r) {
        if (c < 0 || c >= LobeNodeTable::kColumns || r < 0 || r >= LobeNodeTable::kRows) return;
        const double other = row_roughness(r);
        Parameters parameters = parameters_of(texel_nodes(table, c, r), other);
        parameters.head<kLobeNodes>() *= std::pow(roughness / other, 2.0);
        sum += parameters;
        ++count;
    };
    add(column - 1, row);
    add(column + 1, row);
    add(column, row - 1);
    add(column, row + 1);
    return sum / count;
}

/// Fits every texel again, regularised toward its neighbours.
void sweep(LobeNodeTable& table) {
    const LobeNodeTable before = table;
    parallel_for(std::size_t{LobeNodeTable::kColumns} * LobeNodeTable::kRows, [&](std::size_t i) {
        const auto column = static_cast<int>(i % LobeNodeTable::kColumns);
        const auto row = static_cast<int>(i / LobeNodeTable::kColumns);
        const double roughness = row_roughness(row);
        const double view_cosine = column_view_cosine(column);
        const LobeNodes nodes = gauss_nodes(view_cosine, roughness);
        const Parameters mean = neighbour_mean(column, row, before);
        const Parameters fitted = least_squares(Lobe(view_cosine, roughness), nodes, mean, mean, kNeighbourStrength);
        set_texel(table, column, row, with_parameters(nodes, fitted, roughness));
    });
}

}  // namespace

double lobe_misfit(double view_cosine, double roughness, const LobeNodes& nodes) {
    return Lobe(view_cosine, roughness).residual(parameters_of(nodes, roughness), nodes).norm();
}

LobeNodes refine_nodes(double view_cosine, double roughness, const LobeNodes& nodes) {
    const Lobe lobe(view_cosine, roughness);
    const Parameters start = parameters_of(nodes, roughness);
    return with_parameters(nodes, least_squares(lobe, nodes, start, Parameters::Zero(), kMirrorStrength), roughness);
}

LobeNodeTable fit_lobe_nodes() {
    constexpr int kColumns = LobeNodeTable::kColumns;
    constexpr int kRows = LobeNodeTable::kRows;
    LobeNodeTable table{.texels = std::vector<glm::vec4>(std::size_t{LobeNodeTable::kPlanes} * kColumns * kRows)};
    constexpr int kFirstColumn = kColumns / 2;
    constexpr int kFirstRow = kRows * 2 / 3;
    const double view_cosine = column_view_cosine(kFirstColumn);
    LobeNodes nodes = gauss_nodes(view_cosine, row_roughness(kFirstRow));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        nodes.at(i).lean = 0.5 * static_cast<double>(i) - 0.5;
        nodes.at(i).roughness *= 0.75;
    }
    set_texel(table, kFirstColumn, kFirstRow, refine_nodes(view_cosine, row_roughness(kFirstRow), nodes));
    for (int row = kFirstRow; row + 1 < kRows; ++row) fit_texel(kFirstColumn, row + 1, kFirstColumn, row, table);
    for (int row = kFirstRow; row > 0; --row) fit_texel(kFirstColumn, row - 1, kFirstColumn, row, table);
    parallel_for(kRows, [&](std::size_t i) {
        const int row = static_cast<int>(i);
        for (int column = kFirstColumn; column + 1 < kColumns; ++column) fit_texel(column + 1, row, column, row, table);
        for (int column = kFirstColumn; column > 0; --column) fit_texel(column - 1, row, column, row, table);
    });
    for (int i = 0; i < kSweeps; ++i) sweep(table);
    return table;
}

}  // namespace rowland::lighting
