#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_metric.h"
#include "engine/lighting/light_samples.h"

namespace rowland::lighting {

namespace {

using std::numbers::pi;

/// Cells per side of the cube faces on which the probe is summed: .006 rad. A cell's light is at its centroid.
constexpr int kFitFace = 256;

/// Tikhonov regularisation, relative to the matrix's diagonal: keeps overlapping lobes from cancelling each other.
constexpr double kRidge = 1e-3;

/// Cholesky factors of a fit's matrix, which has some tens of rows. Eigen's factorisations are made for hundreds, and
/// would be a tenth of the code that browsers load for the web page.
class Factors {
 public:
    explicit Factors(Eigen::MatrixXd matrix) : lower_(std::move(matrix)) {
        for (Eigen::Index k = 0; k < lower_.rows(); ++k) {
            const Eigen::Index below = lower_.rows() - k;
            for (Eigen::Index j = 0; j < k; ++j) lower_.col(k).tail(below) -= lower_(k, j) * lower_.col(j).tail(below);
            lower_.col(k).tail(below) /= std::sqrt(lower_(k, k));
        }
    }

    Eigen::VectorXd solve(Eigen::VectorXd x) const {
        for (Eigen::Index k = 0; k < x.size(); ++k) {
            x[k] /= lower_(k, k);
            x.tail(x.size() - k - 1) -= x[k] * lower_.col(k).tail(x.size() - k - 1);
        }
        for (Eigen::Index k = x.size() - 1; k >= 0; --k) {
            const Eigen::Index below = x.size() - k - 1;
            x[k] = (x[k] - lower_.col(k).tail(below).dot(x.tail(below))) / lower_(k, k);
        }
        return x;
    }

 private:
    Eigen::MatrixXd lower_;  ///< the triangle above the diagonal is the matrix's
};

/// The indices of `values`, the largest first; equal ones in order.
std::vector<std::size_t> descending(std::span<const double> values) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < values.size(); ++i) order.emplace_back(-values[i], i);
    std::sort(order.begin(), order.end());
    std::vector<std::size_t> indices;
    for (const auto& [value, index] : order) indices.push_back(index);
    return indices;
}

/// Least squares with fluxes ≥ 0: drops the lobes of negative flux and solves for the others, until none is negative.
Eigen::VectorXd solve_non_negative(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
    std::vector<Eigen::Index> used(static_cast<std::size_t>(right.size()));
    std::iota(used.begin(), used.end(), Eigen::Index{0});
    while (!used.empty()) {
        const Eigen::VectorXd x = Factors(matrix(used, used)).solve(right(used));
        if (x.minCoeff() >= 0.0) {
            Eigen::VectorXd all = Eigen::VectorXd::Zero(right.size());
            all(used) = x;
            return all;
        }
        std::vector<Eigen::Index> kept;
        for (std::size_t i = 0; i < used.size(); ++i)
            if (!(x[static_cast<Eigen::Index>(i)] < 0.0)) kept.push_back(used[i]);
        used = std::move(kept);
    }
    return Eigen::VectorXd::Zero(right.size());
}

/// Lobes and their least-squares fluxes.
class Fit {
 public:
    explicit Fit(const MeasuredProbe& probe) : probe_(&probe) {}

    const std::vector<MeasuredLobe>& lobes() const { return lobes_; }
    const Eigen::MatrixX3d& fluxes() const { return fluxes_; }
    /// By how much the lobes reduce the squared error.
    double gain() const { return gain_; }

    void add(const LobeShape& lobe) {
        lobes_.emplace_back();
        const auto n = static_cast<Eigen::Index>(lobes_.size());
        right_.conservativeResize(n, 3);
        matrix_.conservativeResize(n, n);
        replace(lobes_.size() - 1, lobe);
    }

    /// Replaces a lobe if that increases the gain; returns whether it did.
    bool try_replace(std::size_t k, const LobeShape& lobe) {
        Fit changed = *this;
        changed.replace(k, lobe);
        if (!(changed.gain_ > gain_)) return false;
        *this = std::move(changed);
        return true;
    }

    /// Indices sorted by importance: repeatedly removes the lobe whose removal, at fixed fluxes of the others, raises
    /// the squared error least. The last one removed comes first.
    std::vector<std::size_t> by_importance() const {
        Eigen::MatrixX3d residual = right_ - matrix_ * fluxes_;
        std::vector<std::size_t> order;
        std::vector<std::size_t> left(lobes_.size());
        std::iota(left.begin(), left.end(), std::size_t{0});
        const auto loss = [&](std::size_t k) {
            const auto row = static_cast<Eigen::Index>(k);
            return fluxes_.row(row).dot(2.0 * residual.row(row) + matrix_(row, row) * fluxes_.row(row));
        };
        while (!left.empty()) {
            const auto least = std::min_element(left.begin(), left.end(),
                                                [&](std::size_t a, std::size_t b) { return loss(a) < loss(b); });
            const auto row = static_cast<Eigen::Index>(*least);
            residual += matrix_.col(row) * fluxes_.row(row);
            order.push_back(*least);
            left.erase(least);
        }
        std::reverse(order.begin(), order.end());
        return order;
    }

    /// Removes the lobe that costs the least gain, if fluxes of either sign are allowed.
    void remove_least() {
        const Factors factors(matrix_);
        Eigen::VectorXd losses(matrix_.rows());
        for (Eigen::Index k = 0; k < losses.size(); ++k)
            losses[k] = fluxes_.row(k).squaredNorm() / factors.solve(Eigen::VectorXd::Unit(losses.size(), k))[k];
        Eigen::Index least = 0;
        losses.minCoeff(&least);
        std::vector<Eigen::Index> kept(lobes_.size());
        std::iota(kept.begin(), kept.end(), Eigen::Index{0});
        kept.erase(kept.begin() + least);
        lobes_.erase(lobes_.begin() + least);
        right_ = right_(kept, Eigen::all).eval();
        matrix_ = matrix_(kept, kept).eval();
        solve_fluxes();
    }

 private:
    void replace(std::size_t k, const LobeShape& lobe) {
        lobes_[k] = probe_->measure(lobe);
        const auto row = static_cast<Eigen::Index>(k);
        const glm::dvec3 with_probe = probe_->with(lobes_[k]);
        right_.row(row) << with_probe.x, with_probe.y, with_probe.z;
        for (std::size_t j = 0; j < lobes_.size(); ++j) {
            const LobeProduct product(1.0 / lobe.concentration + 1.0 / lobes_[j].shape.concentration,
                                      probe_->settings());
            const auto column = static_cast<Eigen::Index>(j);
            matrix_(row, column) = matrix_(column, row) =
                inner_product(lobes_[k], lobes_[j], product) * (j == k ? 1.0 + kRidge : 1.0);
        }
        solve_fluxes();
    }

    void solve_fluxes() {
        const Factors factors(matrix_);
        fluxes_.resize(right_.rows(), 3);
        for (int c = 0; c < 3; ++c) {
            fluxes_.col(c) = factors.solve(right_.col(c));
            if (fluxes_.col(c).minCoeff() < 0.0) fluxes_.col(c) = solve_non_negative(matrix_, right_.col(c));
        }
        gain_ = fluxes_.cwiseProduct(right_).sum();
    }

    const MeasuredProbe* probe_;
    std::vector<MeasuredLobe> lobes_;
    Eigen::MatrixX3d right_;   ///< ⟨probe, lobe⟩ by channel
    Eigen::MatrixXd matrix_;   ///< ⟨lobe, lobe⟩
    Eigen::MatrixX3d fluxes_;  ///< by channel
    double gain_ = 0.0;
};

/// Lobes of one concentration that greedy selection tries; refinement changes them.
struct TrialLobes {
    double concentration;
    int side;           ///< nodes per side of a cube face; each lobe is at the centroid of a node's light
    std::size_t count;  ///< most lobes, which are those at the nodes of the largest flux
};
constexpr std::array<TrialLobes, 5> kTrialLobes{
    {{40.0, 16, 1536}, {150.0, 32, 2048}, {600.0, 64, 1024}, {3000.0, 64, 1024}, {20000.0, 64, 1024}}};

std::vector<glm::dvec3> trial_directions(const CubeTree& tree, const TrialLobes& trial) {
    const int depth = std::countr_zero(static_cast<unsigned>(trial.side / CubeTree::kRootSide));
    std::vector<const CubeTree::Node*> nodes;
    std::vector<double> fluxes;
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < trial.side; ++row)
            for (int column = 0; column < trial.side; ++column) {
                const CubeTree::Node& node = tree.node(depth, face, column, row);
                nodes.push_back(&node);
                fluxes.push_back(node.flux.x + node.flux.y + node.flux.z);
            }
    std::vector<std::size_t> brightest = descending(fluxes);
    brightest.resize(std::min(brightest.size(), trial.count));
    std::vector<glm::dvec3> directions;
    for (const std::size_t i : brightest) directions.push_back(glm::normalize(glm::dvec3(nodes[i]->source)));
    return directions;
}

/// The lobes that greedy selection chooses from, with their inner products.
class Candidates {
 public:
    Candidates(const MeasuredProbe& probe, double narrowest) : settings_(probe.settings()) {
        std::vector<LobeShape> shapes;
        for (const TrialLobes& trial : kTrialLobes)
            for (const glm::dvec3& direction : trial_directions(probe.tree(), trial))
                shapes.push_back({direction, std::min(trial.concentration, narrowest)});
        candidates_.resize(shapes.size());
        parallel_for(shapes.size(), [&](std::size_t i) {
            Candidate& candidate = candidates_[i];
            candidate.lobe = probe.measure(shapes[i]);
            candidate.with_probe = probe.with(candidate.lobe);
            candidate.norm =
                inner_product(candidate.lobe, candidate.lobe, LobeProduct(2.0 / shapes[i].concentration, settings_));
        });
    }

    /// The candidate that reduces a fit's residual most. The fit must have one lobe more than at the previous call.
    LobeShape best(const Fit& fit) {
        if (!fit.lobes().empty()) add_column(fit.lobes().back());
        std::size_t best = 0;
        double best_gain = -1.0;
        for (std::size_t i = 0; i < candidates_.size(); ++i) {
            glm::dvec3 residual = candidates_[i].with_probe;
            for (std::size_t k = 0; k < with_lobes_.size(); ++k) {
                const auto row = static_cast<Eigen::Index>(k);
                residual -=
                    with_lobes_[k][i] * glm::dvec3(fit.fluxes()(row, 0), fit.fluxes()(row, 1), fit.fluxes()(row, 2));
            }
            residual = glm::max(residual, glm::dvec3(0.0));
            const double gain = glm::dot(residual, residual) / candidates_[i].norm;
            if (gain <= best_gain) continue;
            best_gain = gain;
            best = i;
        }
        return candidates_[best].lobe.shape;
    }

 private:
    struct Candidate {
        MeasuredLobe lobe;
        double norm = 0.0;  ///< ⟨candidate, candidate⟩
        glm::dvec3 with_probe{0.0};
    };

    void add_column(const MeasuredLobe& lobe) {
        std::vector<double>& column = with_lobes_.emplace_back(candidates_.size());
        constexpr std::size_t kBlock = 512;
        parallel_for((candidates_.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
            std::optional<LobeProduct> product;
            double concentration = 0.0;
            const std::size_t begin = block * kBlock;
            for (std::size_t i = begin; i < std::min(begin + kBlock, candidates_.size()); ++i) {
                const MeasuredLobe& candidate = candidates_[i].lobe;
                if (candidate.shape.concentration != concentration) {
                    concentration = candidate.shape.concentration;
                    product.emplace(1.0 / concentration + 1.0 / lobe.shape.concentration, settings_);
                }
                column[i] = inner_product(candidate, lobe, *product);
            }
        });
    }

    KeyLightFit settings_;
    std::vector<Candidate> candidates_;
    std::vector<std::vector<double>> with_lobes_;  ///< ⟨candidate, lobe⟩, lobe by lobe
};

/// One step of a line search for lobe `k`: along two tangents, then in width, where that increases the gain.
void refine(Fit& fit, std::size_t k, double step, double narrowest, const KeyLightFit& settings) {
    const auto moved = [&](int side) {
        const LobeShape lobe = fit.lobes()[k].shape;
        const glm::dvec3 axis = std::abs(lobe.direction.y) < 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        const glm::dvec3 first = glm::normalize(glm::cross(axis, lobe.direction));
        const glm::dvec3 tangent = side < 2 ? first : glm::cross(lobe.direction, first);
        const double width = step * std::sqrt(1.0 / lobe.concentration + 2.0 / settings.smoothing);
        return LobeShape{glm::normalize(lobe.direction + (side % 2 == 0 ? width : -width) * tangent),
                         lobe.concentration};
    };
    for (const int side : {0, 2})
        if (!fit.try_replace(k, moved(side))) fit.try_replace(k, moved(side + 1));
    const auto scaled = [&](double factor) {
        LobeShape lobe = fit.lobes()[k].shape;
        lobe.concentration = std::clamp(lobe.concentration * factor, kWidestConcentration, narrowest);
        return lobe;
    };
    const double factor = 1.0 + 2.0 * step;
    if (!fit.try_replace(k, scaled(factor))) fit.try_replace(k, scaled(1.0 / factor));
}

std::vector<KeyLight> by_importance(const Fit& fit) {
    std::vector<KeyLight> keys;
    for (const std::size_t k : fit.by_importance()) {
        const Eigen::RowVector3d flux = fit.fluxes().row(static_cast<Eigen::Index>(k));
        const LobeShape& shape = fit.lobes()[k].shape;
        // The last bits of a fit differ between C libraries, and cooked files shall not.
        const glm::vec3 rounded(flux[0], flux[1], flux[2]);
        if (flux.any()) keys.push_back({shape.direction, glm::dvec3(rounded), shape.concentration});
    }
    return keys;
}

}  // namespace

std::vector<KeyLight> fit_key_lights(const ProbeImage& probe, int count, const KeyLightFit& settings) {
    ROWLAND_CHECK_OP(count, >=, 0);
    ROWLAND_CHECK_OP(count, <=, kMaximumKeyLights);
    ROWLAND_CHECK_OP(settings.smoothing, >, 0.0);
    if (count == 0) return {};
    const MeasuredProbe measured(bin_into_cells(probe, kFitFace), kFitFace, settings);
    // Bilinear interpolation spreads a texel's light with a variance of a sixth of the square of its side.
    const double side = std::max(2.0 * pi / probe.image().width, pi / probe.image().height);
    const double narrowest = std::clamp(6.0 / (side * side), kWidestConcentration, kNarrowestConcentration);
    Candidates candidates(measured, narrowest);
    Fit fit(measured);
    const auto wanted = static_cast<std::size_t>(count);
    while (fit.lobes().size() < wanted + wanted / 2) {
        const double before = fit.gain();
        fit.add(candidates.best(fit));
        for (const double step : {0.6, 0.3, 0.15}) refine(fit, fit.lobes().size() - 1, step, narrowest, settings);
        if (!(fit.gain() > before * (1.0 + 1e-9))) break;
    }
    const auto refine_all = [&](double step) {
        for (std::size_t k = 0; k < fit.lobes().size(); ++k) refine(fit, k, step, narrowest, settings);
    };
    if (fit.lobes().size() > wanted) refine_all(0.3);
    while (fit.lobes().size() > wanted) {
        fit.remove_least();
        if (fit.lobes().size() % 4 == 0) refine_all(0.2);
    }
    for (const double step : {0.5, 0.3, 0.2, 0.1, 0.05, 0.02, 0.01}) refine_all(step);
    return by_importance(fit);
}

}  // namespace rowland::lighting
