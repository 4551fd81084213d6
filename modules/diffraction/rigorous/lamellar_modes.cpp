// Lamellar reliefs. In the stretched coordinate u, x = x(u), f = dx/du, a uniform medium's plane waves are the
// eigenvectors of K v = κ F v (K = diag(α), F the Toeplitz matrix of f): one real symmetric problem for all media and
// both polarisations. In their basis V (VᵀFV = 1) the equations of a slice are those of the plain method with α
// replaced by κ, and the relief is one matrix B = VᵀF₁V, F₁ being f on the raised bars and 0 elsewhere.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/diffraction/rigorous/modes.h"

namespace rowland::diffraction {

namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// dx/du at the walls. Smaller values resolve the walls better and the plane waves worse.
constexpr double kStretchAtWalls = 0.01;

/// The fraction of a period of u that the bar takes: between its own and one half, so that narrow parts are resolved.
double bar_fraction(double duty) {
    return (0.5 + duty) / 2.0;
}

struct StretchedBasis {
    VectorXd kappa;  ///< ascending: the discrete α
    MatrixXd bar;    ///< B: symmetric, eigenvalues in [0, 1]
};

/// The bar, around u = 0, takes Δ of each period of u, the groove the rest. In a part of width w (in pitches)
/// f = w/Δ + (w/Δ − s) cos(2π u/Δ), u from its centre: f = s and f' = 0 at the walls. Its coefficients are those of the
/// window of width Δ, S(n) = sin(πnΔ)/(πn), at n and n ± 1/Δ.
double part_coefficient(double width, double delta, int n) {
    const auto window = [&](double x) { return delta * sinc(x * delta); };
    const double mean = width / delta;
    return mean * window(n) + (mean - kStretchAtWalls) / 2.0 * (window(n - 1.0 / delta) + window(n + 1.0 / delta));
}

StretchedBasis stretched_basis(double duty, const VectorXd& alpha) {
    const double delta = bar_fraction(duty);
    const auto size = alpha.size();
    MatrixXd bars(size, size);
    MatrixXd all(size, size);
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            const int n = std::abs(row - column);
            bars(row, column) = part_coefficient(duty, delta, n);
            all(row, column) =
                bars(row, column) + (n % 2 == 0 ? 1.0 : -1.0) * part_coefficient(1.0 - duty, 1.0 - delta, n);
        }
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(alpha.asDiagonal().toDenseMatrix(), all);
    const MatrixXd& v = solver.eigenvectors();
    return {solver.eigenvalues(), v.transpose() * bars * v};
}

/// A homogeneous medium or film: plane waves of the basis.
Modes uniform(const VectorXd& kappa, Complex permittivity, Polarisation polarisation, double thickness) {
    const auto size = kappa.size();
    VectorXcd gamma(size);
    for (int i = 0; i < size; ++i) gamma[i] = vertical_component(permittivity, kappa[i]);
    const MatrixXcd flux = (polarisation == Polarisation::TE ? gamma : VectorXcd(gamma / permittivity)).asDiagonal();
    const VectorXcd across = (gamma * Complex(0.0, thickness)).array().exp();
    const MatrixXcd identity = MatrixXcd::Identity(size, size);
    return {identity, flux, identity, -flux, across, across};
}

/// A slice of bars and grooves. TE: ∂²E/∂z² = (κ² − E)E, E = VᵀF_εV. TM: ∂²H/∂z² = P⁻¹(κ E⁻¹ κ − 1)H, P = VᵀF_{1/ε}V.
Modes periodic(const StretchedBasis& basis, Complex bar, Complex groove, Polarisation polarisation, double thickness) {
    const auto size = basis.kappa.size();
    const MatrixXcd identity = MatrixXcd::Identity(size, size);
    const VectorXcd kappa = basis.kappa.cast<Complex>();
    const MatrixXcd permittivity = groove * identity + (bar - groove) * basis.bar;
    const MatrixXcd impermittivity = identity / groove + (1.0 / bar - 1.0 / groove) * basis.bar;
    MatrixXcd matrix;
    if (polarisation == Polarisation::TE) {
        matrix = -permittivity;
        matrix.diagonal() += kappa.cwiseAbs2();
    } else {
        matrix = kappa.asDiagonal() * permittivity.inverse() * kappa.asDiagonal() - identity;
        matrix = impermittivity.partialPivLu().solve(matrix).eval();
    }
    const Eigen::ComplexEigenSolver<MatrixXcd> solver(matrix);
    VectorXcd gamma(size);
    for (int i = 0; i < size; ++i) gamma[i] = vertical_component(-solver.eigenvalues()[i], 0.0);
    const MatrixXcd& field = solver.eigenvectors();
    MatrixXcd flux = field * gamma.asDiagonal();
    if (polarisation == Polarisation::TM) flux = impermittivity * flux;
    const VectorXcd across = (gamma * Complex(0.0, thickness)).array().exp();
    return {field, flux, field, -flux, across, across};
}

/// One column of the relief: media from the substrate up, `ends` their upper ends in nm. The last medium has no end.
struct Column {
    std::vector<Complex> permittivities;
    std::vector<double> ends_nm;

    Complex at(double height_nm) const {
        const auto above = std::upper_bound(ends_nm.begin(), ends_nm.end(), height_nm);
        return permittivities[static_cast<std::size_t>(above - ends_nm.begin())];
    }
};

Column column(const Relief& relief, Complex substrate, double height_nm) {
    Column result{{substrate * substrate}, {height_nm}};
    for (const DielectricFilm& film : relief.films) {
        result.permittivities.emplace_back(film.ior * film.ior);
        result.ends_nm.push_back(result.ends_nm.back() + film.thickness_nm);
    }
    result.permittivities.emplace_back(relief.ambient_ior * relief.ambient_ior);
    return result;
}

}  // namespace

double largest_stretch(const LamellarProfile& shape, double) {
    const double delta = bar_fraction(shape.duty);
    return 2.0 * std::max(shape.duty / delta, (1.0 - shape.duty) / (1.0 - delta));
}

Stack lamellar_stack(const Relief& relief, Complex substrate, const Basis& basis) {
    const auto* shape = std::get_if<LamellarProfile>(&relief.shape);
    const double depth_nm = shape ? shape->depth_nm : 0.0;
    const Column groove = column(relief, substrate, 0.0);
    const Column bar = column(relief, substrate, depth_nm);
    std::vector<double> heights_nm = groove.ends_nm;
    heights_nm.insert(heights_nm.end(), bar.ends_nm.begin(), bar.ends_nm.end());
    std::sort(heights_nm.begin(), heights_nm.end());

    StretchedBasis stretched{basis.alpha, {}};
    if (depth_nm > 0.0) {
        stretched = stretched_basis(shape->duty, basis.alpha);
        // Orders that may propagate have their exact α: they cut off exactly where the grating equation says.
        const double largest = std::max(relief.ambient_ior, substrate.real());
        for (int i = 0; i < basis.alpha.size(); ++i)
            if (std::abs(basis.alpha[i]) < largest) stretched.kappa[i] = basis.alpha[i];
    }
    Stack stack;
    for (const Polarisation polarisation : {Polarisation::TE, Polarisation::TM}) {
        std::vector<Modes>& modes = stack.modes[static_cast<int>(polarisation)];
        modes.push_back(uniform(stretched.kappa, substrate * substrate, polarisation, 0.0));
        for (std::size_t i = 1; i < heights_nm.size(); ++i) {
            const double thickness_nm = heights_nm[i] - heights_nm[i - 1];
            if (thickness_nm <= 0.0) continue;
            const double middle_nm = (heights_nm[i] + heights_nm[i - 1]) / 2.0;
            const double thickness = 2.0 * std::numbers::pi * thickness_nm / basis.wavelength_nm;
            const Complex low = groove.at(middle_nm);
            const Complex high = bar.at(middle_nm);
            modes.push_back(low == high ? uniform(stretched.kappa, low, polarisation, thickness)
                                        : periodic(stretched, high, low, polarisation, thickness));
        }
        Modes top = uniform(stretched.kappa, groove.permittivities.back(), polarisation, 0.0);
        const Propagating incident = propagating(basis, relief.ambient_ior);
        top.field_down = top.field_down.middleCols(incident.first, incident.gamma.size()).eval();
        top.flux_down = top.flux_down.middleCols(incident.first, incident.gamma.size()).eval();
        modes.push_back(std::move(top));
    }
    stack.up = propagating(basis, relief.ambient_ior).first;
    stack.down = propagating(basis, substrate).first;
    return stack;
}

}  // namespace rowland::diffraction
