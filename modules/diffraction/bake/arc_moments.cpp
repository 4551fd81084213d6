#include "modules/diffraction/bake/arc_moments.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/check.h"
#include "engine/math/sh_basis.h"
#include "modules/diffraction/bake/arc_coefficients.h"

namespace rowland::diffraction {

namespace {

using Eigen::MatrixXd;

/// Samples a = cos ϑ for a fit by sines; `shift` in (0, 1) distinguishes sets of samples.
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
    std::vector<double> turned(count);
    for (int k = 0; k < arc_moment_count(bands); ++k) {
        for (std::size_t i = 0; i < count; ++i) row[i] = map(k, static_cast<Eigen::Index>(i));
        arcs.to_tangent_frame(row, turned);
        matrix_.insert(matrix_.end(), turned.begin(), turned.end());
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

}  // namespace rowland::diffraction
