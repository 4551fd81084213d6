#include "modules/diffraction/bake/arc_moments.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/math/spherical_harmonics.h"

namespace rowland::diffraction {

namespace {

using Eigen::MatrixXd;

/// Sample a = cos ϑ of a fit by sines; `shift` in (0, 1) distinguishes sets of samples.
double sample_position(int index, int count, double shift) {
    return std::cos(std::numbers::pi * (index + shift) / count);
}

/// Column i: C_i(a) in the arc frame (h, n, g); row: the samples.
MatrixXd arc_coefficients(const ArcCoefficients& arcs, int samples, double shift) {
    const int count = math::sh_count(arcs.bands());
    MatrixXd result(samples, count);
    std::vector<double> arc(static_cast<std::size_t>(count));
    for (int p = 0; p < samples; ++p) {
        std::fill(arc.begin(), arc.end(), 0.0);
        arcs.accumulate(sample_position(p, samples, shift), 0.0, 0.0, 1.0, arc);
        for (int i = 0; i < count; ++i) result(p, i) = arc[static_cast<std::size_t>(i)];
    }
    return result;
}

MatrixXd arc_basis(int bands, int samples, double shift) {
    const int moments = arc_moment_count(bands);
    MatrixXd result(samples, moments);
    std::vector<double> basis(static_cast<std::size_t>(moments));
    for (int p = 0; p < samples; ++p) {
        evaluate_arc_basis(sample_position(p, samples, shift), bands, basis);
        for (int k = 0; k < moments; ++k) result(p, k) = basis[static_cast<std::size_t>(k)];
    }
    return result;
}

/// In the arc frame Y_lm has the factor r^|m|; only even m ≥ 0 and m = −1 have an integral around the arc. The former
/// are r times a polynomial, the latter r² times one. Each fit uses one family of sines alone and is well conditioned.
MatrixXd fit(const ArcCoefficients& arcs, int samples) {
    const int bands = arcs.bands();
    const MatrixXd basis = arc_basis(bands, samples, 0.5);
    const MatrixXd values = arc_coefficients(arcs, samples, 0.5);
    MatrixXd result = MatrixXd::Zero(arc_moment_count(bands), math::sh_count(bands));
    const auto even = basis.leftCols(bands).colPivHouseholderQr();
    for (int l = 0; l < bands; ++l)
        for (int m = 0; m <= l; m += 2)
            result.col(math::sh_index(l, m)).head(bands) = even.solve(values.col(math::sh_index(l, m)));
    if (bands == 1) return result;
    const auto odd = basis.rightCols(bands - 1).colPivHouseholderQr();
    for (int l = 1; l < bands; ++l)
        result.col(math::sh_index(l, -1)).tail(bands - 1) = odd.solve(values.col(math::sh_index(l, -1)));
    return result;
}

}  // namespace

void evaluate_arc_basis(double a, int bands, std::span<double> values) {
    ROWLAND_CHECK_OP(values.size(), >=, static_cast<std::size_t>(arc_moment_count(bands)));
    std::fill(values.begin(), values.end(), 0.0);
    if (std::abs(a) >= 1.0) return;
    const double r = std::sqrt((1.0 - a) * (1.0 + a));
    double before = 0.0;
    double now = r;  // r U_0
    for (std::size_t k = 0; k < static_cast<std::size_t>(bands); ++k) {
        values[k] = now;
        if (k + 1 < static_cast<std::size_t>(bands)) values[static_cast<std::size_t>(bands) + k] = r * now;
        const double next = 2.0 * a * now - before;
        before = now;
        now = next;
    }
}

ArcMoments::ArcMoments(int bands) : bands_(bands) {
    const ArcCoefficients arcs(bands, FlatLobe{});
    const MatrixXd map = fit(arcs, 4 * bands);
    const MatrixXd error = arc_basis(bands, 5 * bands, 0.3) * map - arc_coefficients(arcs, 5 * bands, 0.3);
    residual_ = error.cwiseAbs().maxCoeff();
    const auto count = static_cast<std::size_t>(math::sh_count(bands));
    std::vector<double> row(count);
    std::vector<double> tangent_row(count);
    for (int k = 0; k < arc_moment_count(bands); ++k) {
        for (std::size_t i = 0; i < count; ++i) row[i] = map(k, static_cast<Eigen::Index>(i));
        arcs.to_tangent_frame(row, tangent_row);
        matrix_.insert(matrix_.end(), tangent_row.begin(), tangent_row.end());
    }
}

std::vector<glm::dvec3> ArcMoments::operator()(const lighting::ShLight& tangent_light) const {
    const auto count = static_cast<std::size_t>(math::sh_count(bands_));
    const std::size_t common = std::min(count, tangent_light.coefficients.size());
    std::vector<glm::dvec3> moments(static_cast<std::size_t>(arc_moment_count(bands_)), glm::dvec3(0.0));
    for (std::size_t k = 0; k < moments.size(); ++k)
        for (std::size_t i = 0; i < common; ++i) moments[k] += matrix_[k * count + i] * tangent_light.coefficients[i];
    return moments;
}

namespace {

using std::numbers::pi;

/// Gauss–Legendre needs π nodes per wave, and a few more where cos t stretches waves.
constexpr int kNodesPerWave = 6;

/// T(r sin t) of a cover bends toward the ends of the arc.
constexpr int kCoverNodes = 16;

/// An order of a pit sequence is integrated up to so many σ on either side: beyond is 8e-11 of it.
constexpr double kOrderReach = 6.5;
/// Nodes of that bump, besides those of the smooth factors.
constexpr int kOrderNodes = 18;

/// The flat lobe's integrand is a trigonometric polynomial of degree `bands` in t over half a period: 16 nodes give
/// 1e-15 at 5 bands. A lobe's core may be a bump as narrow as 1/17 of the interval: 40 nodes more.
int core_node_count(int bands, const GrooveLobe& lobe) {
    const int smooth = std::max(16, 2 * bands + 6);
    if (std::holds_alternative<PitSequenceLobe>(lobe)) return smooth + kOrderNodes;
    const int waves = static_cast<int>(2.0 * lobe_extent(lobe).core_half_width / lobe_extent(lobe).tail_feature_size);
    return is_flat(lobe) ? smooth : smooth + 40 + kNodesPerWave * waves;
}

/// Beyond its core a lobe varies in waves along the arc, which spans at most 2 in s_h. A pit sequence has no tail.
int tail_node_count(int bands, const GrooveLobe& lobe) {
    if (std::holds_alternative<PitSequenceLobe>(lobe)) return 1;
    const int waves = static_cast<int>(std::ceil(2.0 / lobe_extent(lobe).tail_feature_size));
    return std::max(16, 2 * bands + 6) + kNodesPerWave * waves;
}

/// The flat lobe's moments are functions of r alone. The nearest pole of a cover's T lies beyond the horizon, at
/// r = −1/√(n² + 1), so that 32 Chebyshev nodes on [0, 1] are accurate to 1e-14 up to n = 3.
constexpr int kRadiusNodes = 32;

struct ChebyshevNode {
    double position;
    double weight;  ///< of the barycentric formula (Berrut & Trefethen 2004, eq. 5.3)
};

std::array<ChebyshevNode, kRadiusNodes> radius_nodes() {
    std::array<ChebyshevNode, kRadiusNodes> nodes{};
    for (int j = 0; j < kRadiusNodes; ++j) {
        const double angle = pi * (j + 0.5) / kRadiusNodes;
        nodes[static_cast<std::size_t>(j)] = {0.5 + 0.5 * std::cos(angle), (j % 2 == 0 ? 1.0 : -1.0) * std::sin(angle)};
    }
    return nodes;
}

/// The cyclic exchange of axes (h, n, g) → (g, h, n). Columns are the images of the first frame's axes.
glm::dmat3 arc_to_tangent_axes() {
    return {0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0};
}

}  // namespace

/// A part of the arc, t from begin to end.
struct ArcCoefficients::Stretch {
    double begin = 0.0;
    double end = 0.0;
    double power = 1.0;  ///< factor of the density
};

/// The arc's radius and the view along the grooves.
struct ArcCoefficients::Circle {
    double r = 0.0;
    double v_h = 0.0;
};

ArcCoefficients::ArcCoefficients(int bands, const GrooveLobe& lobe, const std::optional<Cover>& cover)
    : bands_(bands),
      lobe_(lobe),
      cover_(cover),
      core_rule_(math::gauss_legendre(core_node_count(bands, lobe) + (cover ? kCoverNodes : 0), 0.0, 1.0)),
      tail_rule_(math::gauss_legendre(tail_node_count(bands, lobe) + (cover ? kCoverNodes : 0), 0.0, 1.0)),
      to_tangent_frame_(arc_to_tangent_axes(), bands) {
    if (is_flat(lobe))
        for (const ChebyshevNode& node : radius_nodes()) of_radius_.push_back(integrated(node.position, 0.0, 0.0));
}

ArcCoefficients::Moments ArcCoefficients::moments(double r, double v_h, double wavelength_nm) const {
    return is_flat(lobe_) ? interpolated(r) : integrated(r, v_h, wavelength_nm);
}

ArcCoefficients::Moments ArcCoefficients::interpolated(double r) const {
    static const std::array<ChebyshevNode, kRadiusNodes> nodes = radius_nodes();
    Moments result;
    double sum = 0.0;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
        if (r == nodes[j].position) return of_radius_[j];
        const double weight = nodes[j].weight / (r - nodes[j].position);
        sum += weight;
        // w is even about the arc's top: the other moments vanish.
        for (std::size_t m = 0; m < static_cast<std::size_t>(bands_); m += 2)
            result.cosine[m] += weight * of_radius_[j].cosine[m];
        for (std::size_t m = 1; m < static_cast<std::size_t>(bands_); m += 2)
            result.sine[m] += weight * of_radius_[j].sine[m];
    }
    for (double& moment : result.cosine) moment /= sum;
    for (double& moment : result.sine) moment /= sum;
    return result;
}

/// Order by order: a rule over the whole arc that resolves their width takes four to six times as long.
ArcCoefficients::Moments ArcCoefficients::summed_orders(const PitSequenceLobe& lobe, double r, double v_h,
                                                        double wavelength_nm) const {
    const double half_width = kOrderReach * lobe.sigma;
    const LobeDensity gaussian(GaussianLobe{lobe.sigma}, wavelength_nm);
    Moments result;
    for (const PitOrder& order : pit_orders(lobe, wavelength_nm, r + std::abs(v_h) + half_width)) {
        const double shifted_v_h = v_h - order.centre;
        const double begin = std::acos(std::clamp((half_width - shifted_v_h) / r, -1.0, 1.0));
        const double end = std::acos(std::clamp((-half_width - shifted_v_h) / r, -1.0, 1.0));
        add_moments(core_rule_, {begin, end, order.power}, {r, shifted_v_h}, gaussian, result);
    }
    return result;
}

ArcCoefficients::Moments ArcCoefficients::integrated(double r, double v_h, double wavelength_nm) const {
    if (const auto* sequence = std::get_if<PitSequenceLobe>(&lobe_))
        return summed_orders(*sequence, r, v_h, wavelength_nm);
    const double core = lobe_extent(lobe_).core_half_width;
    const double begin = is_flat(lobe_) ? 0.0 : std::acos(std::clamp((core - v_h) / r, -1.0, 1.0));
    const double end = is_flat(lobe_) ? pi : std::acos(std::clamp((-core - v_h) / r, -1.0, 1.0));
    const LobeDensity density(lobe_, wavelength_nm);
    Moments result;
    add_moments(core_rule_, {begin, end}, {r, v_h}, density, result);
    if (lobe_extent(lobe_).half_width > core) {
        add_moments(tail_rule_, {0.0, begin}, {r, v_h}, density, result);
        add_moments(tail_rule_, {end, pi}, {r, v_h}, density, result);
    }
    return result;
}

void ArcCoefficients::add_moments(const math::QuadratureRule& rule, const Stretch& stretch, const Circle& arc,
                                  const LobeDensity& density, Moments& result) const {
    const double length = stretch.end - stretch.begin;
    if (length <= 0.0 || stretch.power == 0.0) return;
    for (std::size_t node = 0; node < rule.nodes.size(); ++node) {
        const double t = stretch.begin + length * rule.nodes[node];
        const double c = std::cos(t);
        const double s = std::sin(t);
        const double weight = stretch.power * length * rule.weights[node] * arc.r * s * density(arc.r * c + arc.v_h) *
                              transmittance(cover_, arc.r * s);
        // cos mt and sin mt by recurrence.
        double cosine = weight;
        double sine = 0.0;
        for (std::size_t m = 0; m < static_cast<std::size_t>(bands_); ++m) {
            result.cosine[m] += cosine;
            result.sine[m] += sine;
            const double next = cosine * c - sine * s;
            sine = sine * c + cosine * s;
            cosine = next;
        }
    }
}

void ArcCoefficients::accumulate(double a, double v_h, double wavelength_nm, double weight,
                                 std::span<double> sum) const {
    if (std::abs(a) >= 1.0 || weight == 0.0) return;
    const double r = std::sqrt((1.0 - a) * (1.0 + a));
    const Moments arc = moments(r, v_h, wavelength_nm);
    // At t = 0 every Y_lm with m ≥ 0 is its function of a.
    std::array<double, math::sh_count(math::kMaximumBands)> polar;
    math::evaluate_sh({r, 0.0, a}, bands_, polar);
    for (int l = 0; l < bands_; ++l) {
        for (int m = 0; m <= l; ++m) {
            const double amplitude = weight * polar[static_cast<std::size_t>(math::sh_index(l, m))];
            const auto k = static_cast<std::size_t>(m);
            sum[static_cast<std::size_t>(math::sh_index(l, m))] += amplitude * arc.cosine[k];
            if (m > 0) sum[static_cast<std::size_t>(math::sh_index(l, -m))] += amplitude * arc.sine[k];
        }
    }
}

void ArcCoefficients::to_tangent_frame(std::span<const double> arc_frame, std::span<double> tangent_frame) const {
    to_tangent_frame_.apply(arc_frame, tangent_frame);
}

}  // namespace rowland::diffraction
