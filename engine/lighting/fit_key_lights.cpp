#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/colour/working_space.h"
#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/cube_tree.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_metric.h"
#include "engine/lighting/light_samples.h"

namespace rowland::lighting {

namespace {

using std::numbers::pi;

/// Cells a side of a cube face that the probe is summed in: .006 rad. A cell's light is at its centroid.
constexpr int kFitFace = 256;

/// Tikhonov regularisation, relative to the matrix's diagonal: keeps overlapping lobes from cancelling each other.
constexpr double kRidge = 1e-3;

/// Least squares with fluxes ≥ 0: while a flux is negative, its lobe is left out and the others are solved again.
Eigen::VectorXd solve_non_negative(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
    std::vector<Eigen::Index> used(static_cast<std::size_t>(right.size()));
    std::iota(used.begin(), used.end(), Eigen::Index{0});
    while (!used.empty()) {
        const Eigen::VectorXd x = matrix(used, used).llt().solve(right(used));
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

    const std::vector<LobeShape>& lobes() const { return lobes_; }
    const std::vector<glm::dvec3>& fluxes() const { return fluxes_; }
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

 private:
    void replace(std::size_t k, const LobeShape& lobe) {
        lobes_[k] = lobe;
        const auto row = static_cast<Eigen::Index>(k);
        const glm::dvec3 with_probe = probe_->with(lobe);
        right_.row(row) << with_probe.x, with_probe.y, with_probe.z;
        for (std::size_t j = 0; j < lobes_.size(); ++j) {
            const double product = inner_product(lobe, lobes_[j], probe_->settings()) * (j == k ? 1.0 + kRidge : 1.0);
            const auto column = static_cast<Eigen::Index>(j);
            matrix_(row, column) = matrix_(column, row) = product;
        }
        solve_fluxes();
    }

    void solve_fluxes() {
        fluxes_.assign(lobes_.size(), glm::dvec3(0.0));
        gain_ = 0.0;
        for (int c = 0; c < 3; ++c) {
            const Eigen::VectorXd flux = solve_non_negative(matrix_, right_.col(c));
            for (std::size_t i = 0; i < lobes_.size(); ++i) fluxes_[i][c] = flux[static_cast<Eigen::Index>(i)];
            gain_ += flux.dot(right_.col(c));
        }
    }

    const MeasuredProbe* probe_;
    std::vector<LobeShape> lobes_;
    Eigen::MatrixX3d right_;  ///< ⟨probe, lobe⟩ by channel
    Eigen::MatrixXd matrix_;  ///< ⟨lobe, lobe⟩
    std::vector<glm::dvec3> fluxes_;
    double gain_ = 0.0;
};

/// Lobes of one concentration that greedy selection tries; refinement changes them.
struct TrialLobes {
    double concentration;
    int side;           ///< nodes a side of a cube face, at whose light the lobes are
    std::size_t count;  ///< at most: at the nodes of the largest flux
};
constexpr std::array<TrialLobes, 5> kTrialLobes{
    {{40.0, 16, 1536}, {150.0, 32, 2048}, {600.0, 64, 1024}, {3000.0, 64, 1024}, {20000.0, 64, 1024}}};

std::vector<glm::dvec3> trial_directions(const CubeTree& tree, const TrialLobes& trial) {
    const int depth = std::countr_zero(static_cast<unsigned>(trial.side / CubeTree::kRootSide));
    std::vector<const CubeTree::Node*> nodes;
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < trial.side; ++row)
            for (int column = 0; column < trial.side; ++column) nodes.push_back(&tree.node(depth, face, column, row));
    const auto flux = [](const CubeTree::Node* node) { return node->flux.x + node->flux.y + node->flux.z; };
    std::stable_sort(nodes.begin(), nodes.end(),
                     [&](const CubeTree::Node* a, const CubeTree::Node* b) { return flux(a) > flux(b); });
    nodes.resize(std::min(nodes.size(), trial.count));
    std::vector<glm::dvec3> directions;
    for (const CubeTree::Node* node : nodes) directions.push_back(glm::normalize(glm::dvec3(node->source)));
    return directions;
}

/// The lobes that greedy selection chooses from, with their inner products.
class Candidates {
 public:
    Candidates(const MeasuredProbe& probe, double narrowest) : settings_(probe.settings()) {
        for (const TrialLobes& trial : kTrialLobes) {
            const double concentration = std::min(trial.concentration, narrowest);
            const double norm = LobeProduct(2.0 / concentration, settings_)(1.0);
            for (const glm::dvec3& direction : trial_directions(probe.tree(), trial))
                candidates_.push_back({.shape = {direction, concentration}, .norm = norm});
        }
        parallel_for(candidates_.size(),
                     [&](std::size_t i) { candidates_[i].with_probe = probe.with(candidates_[i].shape); });
    }

    /// The one that reduces the residual of a fit most. The fit has one lobe more than at the call before.
    LobeShape best(const Fit& fit) {
        if (!fit.lobes().empty()) add_column(fit.lobes().back());
        std::size_t best = 0;
        double best_gain = -1.0;
        for (std::size_t i = 0; i < candidates_.size(); ++i) {
            glm::dvec3 residual = candidates_[i].with_probe;
            for (std::size_t k = 0; k < with_lobes_.size(); ++k) residual -= with_lobes_[k][i] * fit.fluxes()[k];
            residual = glm::max(residual, glm::dvec3(0.0));
            const double gain = glm::dot(residual, residual) / candidates_[i].norm;
            if (gain <= best_gain) continue;
            best_gain = gain;
            best = i;
        }
        return candidates_[best].shape;
    }

 private:
    struct Candidate {
        LobeShape shape;
        double norm = 0.0;  ///< ⟨candidate, candidate⟩
        glm::dvec3 with_probe{0.0};
    };

    void add_column(const LobeShape& lobe) {
        std::vector<double>& column = with_lobes_.emplace_back(candidates_.size());
        constexpr std::size_t kBlock = 512;
        parallel_for((candidates_.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
            std::optional<LobeProduct> product;
            const std::size_t begin = block * kBlock;
            for (std::size_t i = begin; i < std::min(begin + kBlock, candidates_.size()); ++i) {
                const LobeShape& shape = candidates_[i].shape;
                if (i == begin || shape.concentration != candidates_[i - 1].shape.concentration)
                    product.emplace(1.0 / shape.concentration + 1.0 / lobe.concentration, settings_);
                column[i] = (*product)(glm::dot(shape.direction, lobe.direction));
            }
        });
    }

    KeyLightFit settings_;
    std::vector<Candidate> candidates_;
    std::vector<std::vector<double>> with_lobes_;  ///< ⟨candidate, lobe⟩, lobe by lobe
};

/// Line search by one step: along two tangents, then in width.
void refine(Fit& fit, std::size_t k, double step, double narrowest, const KeyLightFit& settings) {
    const auto turned = [&](int way) {
        const LobeShape lobe = fit.lobes()[k];
        const glm::dvec3 axis = std::abs(lobe.direction.y) < 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        const glm::dvec3 first = glm::normalize(glm::cross(axis, lobe.direction));
        const glm::dvec3 tangent = way < 2 ? first : glm::cross(lobe.direction, first);
        const double width = step * std::sqrt(1.0 / lobe.concentration + 2.0 / settings.smoothing);
        return LobeShape{glm::normalize(lobe.direction + (way % 2 == 0 ? width : -width) * tangent),
                         lobe.concentration};
    };
    for (const int way : {0, 2})
        if (!fit.try_replace(k, turned(way))) fit.try_replace(k, turned(way + 1));
    const auto scaled = [&](double factor) {
        LobeShape lobe = fit.lobes()[k];
        lobe.concentration = std::clamp(lobe.concentration * factor, kWidestConcentration, narrowest);
        return lobe;
    };
    const double factor = 1.0 + 2.0 * step;
    if (!fit.try_replace(k, scaled(factor))) fit.try_replace(k, scaled(1.0 / factor));
}

std::vector<KeyLight> brightest_first(const Fit& fit) {
    std::vector<KeyLight> keys;
    for (std::size_t k = 0; k < fit.lobes().size(); ++k) {
        const glm::dvec3 flux = fit.fluxes()[k];
        if (flux != glm::dvec3(0.0)) keys.push_back({fit.lobes()[k].direction, flux, fit.lobes()[k].concentration});
    }
    std::stable_sort(keys.begin(), keys.end(), [](const KeyLight& a, const KeyLight& b) {
        return colour::luminance(a.flux) > colour::luminance(b.flux);
    });
    return keys;
}

}  // namespace

std::vector<KeyLight> fit_key_lights(const ProbeImage& probe, int count, const KeyLightFit& settings) {
    ROWLAND_CHECK_OP(count, >=, 0);
    ROWLAND_CHECK_OP(count, <=, kMaximumKeyLights);
    ROWLAND_CHECK_OP(settings.smoothing, >, 0.0);
    if (count == 0) return {};
    const MeasuredProbe measured(CubeTree(gather_cells(probe, kFitFace), kFitFace), settings);
    // A texel's light, bilinear as it is seen, has a variance of a sixth of its side's square.
    const double side = 2.0 * pi / probe.image().width;
    const double narrowest = std::clamp(6.0 / (side * side), kWidestConcentration, kNarrowestConcentration);
    Candidates candidates(measured, narrowest);
    Fit fit(measured);
    while (fit.lobes().size() < static_cast<std::size_t>(count)) {
        const double before = fit.gain();
        fit.add(candidates.best(fit));
        for (const double step : {0.6, 0.3, 0.15}) refine(fit, fit.lobes().size() - 1, step, narrowest, settings);
        if (!(fit.gain() > before * (1.0 + 1e-9))) break;
    }
    for (const double step : {0.5, 0.3, 0.2, 0.1, 0.05, 0.02, 0.01})
        for (std::size_t k = 0; k < fit.lobes().size(); ++k) refine(fit, k, step, narrowest, settings);
    return brightest_first(fit);
}

}  // namespace rowland::lighting
