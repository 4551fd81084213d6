#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_texels.h"
#include "engine/math/sh_basis.h"

namespace rowland::lighting {

namespace {

using std::numbers::pi;

/// Cube faces of the light that lobes are fitted to: cells of 0.025 rad, finer than what a grating's colours resolve.
constexpr int kFaceSize = 64;

/// The error that counts is that of light smoothed by a lobe of this concentration (0.06 rad), about what one order's
/// colours do at a pitch of 1 to 2 µm; and without the bands below kExactBands, which SH carries.
constexpr double kSmoothing = 300.0;
constexpr int kExactBands = 5;

/// Lobes that greedy peeling tries, then refined.
constexpr std::array<double, 3> kTrialConcentrations{40.0, 150.0, 600.0};
constexpr double kNarrowestConcentration = 3000.0;

/// exp(−this) of a lobe's peak is left out of sums.
constexpr double kReach = 12.0;

/// Share by which lobes resist being each other's opposite.
constexpr double kRidge = 1e-3;

struct Shape {
    glm::dvec3 direction{0.0};
    double concentration = 0.0;
};

/// A lobe of this concentration smoothed twice, once for itself and once for what it is compared with. Widths of narrow
/// lobes add; the error of that is of order 1/κ².
double smoothed_twice(double a, double b) {
    return 1.0 / (a + b + 2.0 / kSmoothing);
}

/// Inner products of smoothed light without its low bands: probe with lobes, lobes with lobes.
class SmoothedProbe {
 public:
    explicit SmoothedProbe(const LightTexels& cells)
        : cells_(cells), low_(math::sh_count(kExactBands), glm::dvec3(0.0)) {
        std::array<double, math::sh_count(kExactBands)> basis{};
        for (std::size_t i = 0; i < cells.size(); ++i) {
            math::evaluate_sh(glm::normalize(direction(i)), kExactBands, basis);
            for (std::size_t k = 0; k < basis.size(); ++k) low_[k] += basis[k] * flux(i);
        }
    }

    std::size_t size() const { return cells_.size(); }
    glm::dvec3 direction(std::size_t i) const { return {cells_.x[i], cells_.y[i], cells_.z[i]}; }
    glm::dvec3 flux(std::size_t i) const { return {cells_.red[i], cells_.green[i], cells_.blue[i]}; }

    /// ⟨probe, lobe of flux 1⟩.
    glm::dvec3 with(const Shape& lobe) const {
        const KeyLight wide{lobe.direction, glm::dvec3(1.0), smoothed_twice(1.0 / lobe.concentration, 0.0)};
        const auto concentration = static_cast<float>(wide.concentration);
        const float nearest = 1.0F - static_cast<float>(kReach) / concentration;
        const double peak = lobe_density(wide, lobe.direction);
        const glm::vec3 axis(lobe.direction);
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const float cosine = cells_.x[i] * axis.x + cells_.y[i] * axis.y + cells_.z[i] * axis.z;
            if (cosine <= nearest) continue;
            // Smoothed lobes are so wide that floats' cosines do.
            sum += peak * static_cast<double>(std::exp(concentration * (cosine - 1.0F))) * flux(i);
        }
        std::array<double, math::sh_count(kExactBands)> basis{};
        math::evaluate_sh(lobe.direction, kExactBands, basis);
        const std::vector<double> factors = lobe_band_factors(wide.concentration, kExactBands);
        for (int l = 0; l < kExactBands; ++l)
            for (int m = -l; m <= l; ++m) {
                const auto k = static_cast<std::size_t>(math::sh_index(l, m));
                sum -= factors[static_cast<std::size_t>(l)] * basis[k] * low_[k];
            }
        return sum;
    }

 private:
    const LightTexels& cells_;
    std::vector<glm::dvec3> low_;
};

/// ⟨lobe, lobe⟩, both of flux 1, for lobes of two concentrations.
class LobeProduct {
 public:
    LobeProduct(double a, double b)
        : concentration_(smoothed_twice(1.0 / a, 1.0 / b)),
          peak_(lobe_density({glm::dvec3(0, 1, 0), glm::dvec3(1.0), concentration_}, glm::dvec3(0, 1, 0))),
          factors_(lobe_band_factors(concentration_, kExactBands)) {}

    double operator()(const glm::dvec3& a, const glm::dvec3& b) const {
        const double cosine = glm::dot(a, b);
        double product = peak_ * std::exp(concentration_ * (cosine - 1.0));
        double before = 0.0;
        double legendre = 1.0;
        for (int l = 0; l < kExactBands; ++l) {
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

double between(const Shape& a, const Shape& b) {
    return LobeProduct(a.concentration, b.concentration)(a.direction, b.direction);
}

/// Solves the symmetric positive definite system of those unknowns that are in use, by Cholesky's factors; the others
/// are 0.
std::vector<double> solve(const std::vector<double>& matrix, const std::vector<double>& right,
                          const std::vector<bool>& used) {
    std::vector<std::size_t> index;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i]) index.push_back(i);
    const std::size_t n = index.size();
    std::vector<double> lower(n * n);
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = matrix[index[i] * used.size() + index[j]];
            for (std::size_t k = 0; k < j; ++k) sum -= lower[i * n + k] * lower[j * n + k];
            lower[i * n + j] = i == j ? std::sqrt(std::max(sum, 1e-30)) : sum / lower[j * n + j];
        }
        double sum = right[index[i]];
        for (std::size_t k = 0; k < i; ++k) sum -= lower[i * n + k] * x[k];
        x[i] = sum / lower[i * n + i];
    }
    std::vector<double> result(used.size(), 0.0);
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) x[i] -= lower[k * n + i] * x[k];
        x[i] /= lower[i * n + i];
        result[index[i]] = x[i];
    }
    return result;
}

/// Lobes with the products that their best fluxes follow from.
class Fit {
 public:
    explicit Fit(const SmoothedProbe& probe) : probe_(probe) {}

    const std::vector<Shape>& lobes() const { return lobes_; }
    const std::vector<glm::dvec3>& fluxes() const { return fluxes_; }
    /// What the lobes take off the squared error.
    double gain() const { return gain_; }

    void add(const Shape& lobe) {
        lobes_.push_back(lobe);
        right_.push_back(probe_.with(lobe));
        update();
    }

    /// Moves a lobe if that helps; returns whether it did.
    bool try_move(std::size_t k, const Shape& lobe) {
        const Fit before = *this;
        lobes_[k] = lobe;
        right_[k] = probe_.with(lobe);
        update(k);
        if (gain_ > before.gain_) return true;
        lobes_ = before.lobes_;
        right_ = before.right_;
        matrix_ = before.matrix_;
        fluxes_ = before.fluxes_;
        gain_ = before.gain_;
        return false;
    }

 private:
    void update() {
        const std::size_t n = lobes_.size();
        matrix_.assign(n * n, 0.0);
        for (std::size_t i = 0; i < n; ++i) fill_row(i);
        solve_fluxes();
    }
    void update(std::size_t k) {
        fill_row(k);
        solve_fluxes();
    }
    void fill_row(std::size_t k) {
        const std::size_t n = lobes_.size();
        for (std::size_t j = 0; j < n; ++j) {
            const double product = between(lobes_[k], lobes_[j]) * (j == k ? 1.0 + kRidge : 1.0);
            matrix_[k * n + j] = matrix_[j * n + k] = product;
        }
    }

    /// Least squares a channel; a lobe that would take light away is left out of the channel.
    void solve_fluxes() {
        const std::size_t n = lobes_.size();
        fluxes_.assign(n, glm::dvec3(0.0));
        gain_ = 0.0;
        std::vector<double> right(n);
        for (int c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < n; ++i) right[i] = right_[i][c];
            std::vector<bool> used(n, true);
            std::vector<double> x = solve(matrix_, right, used);
            while (std::any_of(x.begin(), x.end(), [](double flux) { return flux < 0.0; })) {
                for (std::size_t i = 0; i < n; ++i)
                    if (x[i] < 0.0) used[i] = false;
                x = solve(matrix_, right, used);
            }
            for (std::size_t i = 0; i < n; ++i) {
                fluxes_[i][c] = x[i];
                gain_ += x[i] * right[i];
            }
        }
    }

    const SmoothedProbe& probe_;
    std::vector<Shape> lobes_;
    std::vector<glm::dvec3> right_;
    std::vector<double> matrix_;
    std::vector<glm::dvec3> fluxes_;
    double gain_ = 0.0;
};

/// The lobes that peeling may begin with, and how much of the probe's error each would take.
class Candidates {
 public:
    explicit Candidates(const SmoothedProbe& probe) {
        constexpr std::size_t kStride = 4;  // neighbours along a row differ by less than any trial lobe's width
        for (const double concentration : kTrialConcentrations)
            for (std::size_t i = 0; i < probe.size(); i += kStride)
                shapes_.push_back({glm::normalize(probe.direction(i)), concentration});
        products_.resize(shapes_.size());
        parallel_for(shapes_.size(), [&](std::size_t i) { products_[i] = probe.with(shapes_[i]); });
        for (const double concentration : kTrialConcentrations)
            norms_.push_back(between({glm::dvec3(0, 0, 1), concentration}, {glm::dvec3(0, 0, 1), concentration}));
    }

    /// The one that gains most beside the lobes of a fit, which has grown by one lobe since the last call.
    Shape best(const Fit& fit) {
        const std::size_t each = shapes_.size() / kTrialConcentrations.size();
        if (!fit.lobes().empty()) {
            const Shape& lobe = fit.lobes().back();
            std::vector<double>& column = with_lobes_.emplace_back(shapes_.size());
            for (std::size_t trial = 0; trial < kTrialConcentrations.size(); ++trial) {
                const LobeProduct product(kTrialConcentrations[trial], lobe.concentration);
                for (std::size_t i = trial * each; i < (trial + 1) * each; ++i)
                    column[i] = product(shapes_[i].direction, lobe.direction);
            }
        }
        std::size_t best = 0;
        double best_gain = -1.0;
        for (std::size_t i = 0; i < shapes_.size(); ++i) {
            glm::dvec3 left = products_[i];
            for (std::size_t k = 0; k < with_lobes_.size(); ++k) left -= with_lobes_[k][i] * fit.fluxes()[k];
            left = glm::max(left, glm::dvec3(0.0));
            const double gain = glm::dot(left, left) / norms_[i / each];
            if (gain <= best_gain) continue;
            best_gain = gain;
            best = i;
        }
        return shapes_[best];
    }

 private:
    std::vector<Shape> shapes_;
    std::vector<glm::dvec3> products_;
    std::vector<double> norms_;
    std::vector<std::vector<double>> with_lobes_;  ///< ⟨candidate, lobe⟩, lobe by lobe
};

/// One round of small moves of a lobe: along two tangents, then wider and narrower.
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
        if (!fit.try_move(k, turned(way))) fit.try_move(k, turned(way + 1));
    const auto scaled = [&](double factor) {
        Shape lobe = fit.lobes()[k];
        lobe.concentration = std::clamp(lobe.concentration * factor, kWidestConcentration, narrowest);
        return lobe;
    };
    const double factor = 1.0 + step;
    if (!fit.try_move(k, scaled(factor))) fit.try_move(k, scaled(1.0 / factor));
}

std::vector<KeyLight> brightest_first(const Fit& fit) {
    std::vector<KeyLight> keys;
    for (std::size_t k = 0; k < fit.lobes().size(); ++k) {
        const glm::dvec3 flux = fit.fluxes()[k];
        if (flux != glm::dvec3(0.0)) keys.push_back({fit.lobes()[k].direction, flux, fit.lobes()[k].concentration});
    }
    const auto luminance = [](const KeyLight& key) { return glm::dot(key.flux, glm::dvec3(0.2126, 0.7152, 0.0722)); };
    std::stable_sort(keys.begin(), keys.end(),
                     [&](const KeyLight& a, const KeyLight& b) { return luminance(a) > luminance(b); });
    return keys;
}

}  // namespace

std::vector<KeyLight> fit_key_lights(const ProbeImage& probe, int count) {
    ROWLAND_CHECK_OP(count, >=, 0);
    ROWLAND_CHECK_OP(count, <=, kMaximumKeyLights);
    if (count == 0) return {};
    const LightTexels cells = gather_texels(light_texels(probe), kFaceSize);
    if (cells.size() == 0) return {};
    // A lobe's deviation is at least 0.7 of a texel's side.
    const double side = 2.0 * pi / probe.image().width;
    const double narrowest = std::clamp(1.0 / (0.5 * side * side), kWidestConcentration, kNarrowestConcentration);
    const SmoothedProbe smoothed(cells);
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
