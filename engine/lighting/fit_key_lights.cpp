#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <utility>

#include "engine/colour/working_space.h"
#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_samples.h"
#include "engine/math/sh_basis.h"

namespace rowland::lighting {

namespace {

using std::numbers::pi;

/// Cells a side of a cube face that the probe is summed in before lobes are fitted: 0.025 rad.
constexpr int kFaceSize = 64;

/// Concentrations of the lobes that greedy selection tries; refinement changes them.
constexpr std::array<double, 3> kTrialConcentrations{40.0, 150.0, 600.0};
constexpr double kNarrowestConcentration = 3000.0;

/// exp(−this) of a lobe's peak is left out of sums.
constexpr double kReach = 12.0;

/// Tikhonov regularisation, relative to the matrix's diagonal: keeps overlapping lobes from cancelling each other.
constexpr double kRidge = 1e-3;

struct Shape {
    glm::dvec3 direction{0.0};
    double concentration = 0.0;
};

/// Concentration of the convolution of two lobes of variance a and b and of two smoothing kernels, one for each factor
/// of an inner product. Variances of narrow lobes add; the error is of order 1/κ².
double smoothed_twice(double a, double b, const KeyLightFit& settings) {
    return 1.0 / (a + b + 2.0 / settings.smoothing);
}

/// Inner products of the smoothed probe with smoothed lobes, both without their low bands.
class SmoothedProbe {
 public:
    SmoothedProbe(LightSamples cells, const KeyLightFit& settings)
        : cells_(std::move(cells)), settings_(settings), low_(coefficients(), glm::dvec3(0.0)) {
        std::vector<double> basis(coefficients());
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            math::evaluate_sh(glm::normalize(cells_.direction(i)), settings.exact_bands, basis);
            for (std::size_t k = 0; k < basis.size(); ++k) low_[k] += basis[k] * cells_.flux(i);
        }
    }

    const LightSamples& cells() const { return cells_; }
    const KeyLightFit& settings() const { return settings_; }

    /// ⟨probe, lobe of flux 1⟩.
    glm::dvec3 with(const Shape& lobe) const {
        const KeyLight wide{lobe.direction, glm::dvec3(1.0), smoothed_twice(1.0 / lobe.concentration, 0.0, settings_)};
        const auto concentration = static_cast<float>(wide.concentration);
        const float nearest = 1.0F - static_cast<float>(kReach) / concentration;
        const double peak = lobe_density(wide, lobe.direction);
        const glm::vec3 axis(lobe.direction);
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const float cosine = cells_.x[i] * axis.x + cells_.y[i] * axis.y + cells_.z[i] * axis.z;
            if (cosine <= nearest) continue;
            // Single precision suffices: smoothed lobes are wide.
            sum += peak * static_cast<double>(std::exp(concentration * (cosine - 1.0F))) * cells_.flux(i);
        }
        std::vector<double> basis(coefficients());
        math::evaluate_sh(lobe.direction, settings_.exact_bands, basis);
        const std::vector<double> factors = lobe_band_factors(wide.concentration, settings_.exact_bands);
        for (int l = 0; l < settings_.exact_bands; ++l)
            for (int m = -l; m <= l; ++m) {
                const auto k = static_cast<std::size_t>(math::sh_index(l, m));
                sum -= factors[static_cast<std::size_t>(l)] * basis[k] * low_[k];
            }
        return sum;
    }

 private:
    std::size_t coefficients() const { return static_cast<std::size_t>(math::sh_count(settings_.exact_bands)); }

    LightSamples cells_;
    KeyLightFit settings_;
    std::vector<glm::dvec3> low_;  ///< SH of the probe
};

/// ⟨lobe, lobe⟩, both of flux 1, for lobes of two concentrations.
class LobeProduct {
 public:
    LobeProduct(double a, double b, const KeyLightFit& settings)
        : concentration_(smoothed_twice(1.0 / a, 1.0 / b, settings)),
          peak_(lobe_density({glm::dvec3(0, 1, 0), glm::dvec3(1.0), concentration_}, glm::dvec3(0, 1, 0))),
          factors_(lobe_band_factors(concentration_, settings.exact_bands)) {}

    double operator()(const glm::dvec3& a, const glm::dvec3& b) const {
        const double cosine = glm::dot(a, b);
        double product = peak_ * std::exp(concentration_ * (cosine - 1.0));
        double before = 0.0;
        double legendre = 1.0;
        for (int l = 0; l < static_cast<int>(factors_.size()); ++l) {
            product -= (2 * l + 1) / (4.0 * pi) * factors_[static_cast<std::size_t>(l)] * legendre;
            const double next = ((2 * l + 1) * cosine * legendre - l * before) / (l + 1);
            before = legendre;
            legendre = next;
        }
        return product;
    }

 private:
    double concentration_;
    double peak_;
    std::vector<double> factors_;
};

double inner_product(const Shape& a, const Shape& b, const KeyLightFit& settings) {
    return LobeProduct(a.concentration, b.concentration, settings)(a.direction, b.direction);
}

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
    explicit Fit(const SmoothedProbe& probe) : probe_(&probe) {}

    const std::vector<Shape>& lobes() const { return lobes_; }
    const std::vector<glm::dvec3>& fluxes() const { return fluxes_; }
    /// By how much the lobes reduce the squared error.
    double gain() const { return gain_; }

    void add(const Shape& lobe) {
        lobes_.emplace_back();
        const auto n = static_cast<Eigen::Index>(lobes_.size());
        right_.conservativeResize(n, 3);
        matrix_.conservativeResize(n, n);
        replace(lobes_.size() - 1, lobe);
    }

    /// Replaces a lobe if that increases the gain; returns whether it did.
    bool try_replace(std::size_t k, const Shape& lobe) {
        Fit changed = *this;
        changed.replace(k, lobe);
        if (!(changed.gain_ > gain_)) return false;
        *this = std::move(changed);
        return true;
    }

 private:
    void replace(std::size_t k, const Shape& lobe) {
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

    const SmoothedProbe* probe_;
    std::vector<Shape> lobes_;
    Eigen::MatrixX3d right_;  ///< ⟨probe, lobe⟩ by channel
    Eigen::MatrixXd matrix_;  ///< ⟨lobe, lobe⟩
    std::vector<glm::dvec3> fluxes_;
    double gain_ = 0.0;
};

/// The lobes that greedy selection chooses from, with their inner products.
class Candidates {
 public:
    explicit Candidates(const SmoothedProbe& probe) : settings_(probe.settings()) {
        constexpr std::size_t kStride = 4;  // the trial lobes are wider than four cells
        for (const double concentration : kTrialConcentrations)
            for (std::size_t i = 0; i < probe.cells().size(); i += kStride)
                shapes_.push_back({glm::normalize(probe.cells().direction(i)), concentration});
        products_.resize(shapes_.size());
        parallel_for(shapes_.size(), [&](std::size_t i) { products_[i] = probe.with(shapes_[i]); });
        for (const double concentration : kTrialConcentrations)
            norms_.push_back(LobeProduct(concentration, concentration, settings_)({0, 0, 1}, {0, 0, 1}));
    }

    /// The one that reduces the residual of a fit most. The fit has one lobe more than at the call before.
    Shape best(const Fit& fit) {
        const std::size_t each = shapes_.size() / kTrialConcentrations.size();
        if (!fit.lobes().empty()) {
            const Shape& lobe = fit.lobes().back();
            std::vector<double>& column = with_lobes_.emplace_back(shapes_.size());
            for (std::size_t trial = 0; trial < kTrialConcentrations.size(); ++trial) {
                const LobeProduct product(kTrialConcentrations[trial], lobe.concentration, settings_);
                for (std::size_t i = trial * each; i < (trial + 1) * each; ++i)
                    column[i] = product(shapes_[i].direction, lobe.direction);
            }
        }
        std::size_t best = 0;
        double best_gain = -1.0;
        for (std::size_t i = 0; i < shapes_.size(); ++i) {
            glm::dvec3 residual = products_[i];
            for (std::size_t k = 0; k < with_lobes_.size(); ++k) residual -= with_lobes_[k][i] * fit.fluxes()[k];
            residual = glm::max(residual, glm::dvec3(0.0));
            const double gain = glm::dot(residual, residual) / norms_[i / each];
            if (gain <= best_gain) continue;
            best_gain = gain;
            best = i;
        }
        return shapes_[best];
    }

 private:
    KeyLightFit settings_;
    std::vector<Shape> shapes_;
    std::vector<glm::dvec3> products_;             ///< ⟨probe, candidate⟩
    std::vector<double> norms_;                    ///< ⟨candidate, candidate⟩, one for each concentration
    std::vector<std::vector<double>> with_lobes_;  ///< ⟨candidate, lobe⟩, lobe by lobe
};

/// Line search by one step: along two tangents, then in width.
void refine(Fit& fit, std::size_t k, double step, double narrowest) {
    const auto turned = [&](int way) {
        const Shape lobe = fit.lobes()[k];
        const glm::dvec3 axis = std::abs(lobe.direction.y) < 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        const glm::dvec3 first = glm::normalize(glm::cross(axis, lobe.direction));
        const glm::dvec3 tangent = way < 2 ? first : glm::cross(lobe.direction, first);
        const double width = step / std::sqrt(lobe.concentration);
        return Shape{glm::normalize(lobe.direction + (way % 2 == 0 ? width : -width) * tangent), lobe.concentration};
    };
    for (const int way : {0, 2})
        if (!fit.try_replace(k, turned(way))) fit.try_replace(k, turned(way + 1));
    const auto scaled = [&](double factor) {
        Shape lobe = fit.lobes()[k];
        lobe.concentration = std::clamp(lobe.concentration * factor, kWidestConcentration, narrowest);
        return lobe;
    };
    const double factor = 1.0 + step;
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
    const SmoothedProbe smoothed(cell_samples(gather_cells(probe, kFaceSize)), settings);
    if (smoothed.cells().size() == 0) return {};
    // A lobe's deviation is at least 0.7 of a texel's side.
    const double side = 2.0 * pi / probe.image().width;
    const double narrowest = std::clamp(1.0 / (0.5 * side * side), kWidestConcentration, kNarrowestConcentration);
    Candidates candidates(smoothed);
    Fit fit(smoothed);
    while (fit.lobes().size() < static_cast<std::size_t>(count)) {
        const double before = fit.gain();
        fit.add(candidates.best(fit));
        for (const double step : {0.6, 0.3, 0.15}) refine(fit, fit.lobes().size() - 1, step, narrowest);
        if (!(fit.gain() > before * (1.0 + 1e-9))) break;
    }
    for (const double step : {0.5, 0.3, 0.2, 0.1, 0.05})
        for (std::size_t k = 0; k < fit.lobes().size(); ++k) refine(fit, k, step, narrowest);
    return brightest_first(fit);
}

}  // namespace rowland::lighting
