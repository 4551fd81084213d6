// Sinusoidal and blazed reliefs. The relief is a curve (X(u), Z(u)); every surface of the stack is that curve moved by
// w along the unit vector t, and (u, w) are the coordinates. With e = (X', Z'), J = e × t and b = e · t the equations
// of a homogeneous medium of index n for the field F and its flux G = −i |e| ∂F/∂n through a surface w = const are
//     −i ∂/∂w (F, G) = ( c α     E   ) (F, G),   E = (J + b J⁻¹ b)⁻¹,   c = E b J⁻¹,
//                      ( n²J − αEα  α cᴴ )
// where J and b are Toeplitz matrices: F, ∂F/∂w and the flux through u = const are continuous at the relief's edges, so
// each product has at most one discontinuous factor (Li 1996).
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "modules/diffraction/rigorous/modes.h"

namespace rowland::diffraction {

namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;
using std::numbers::pi;

/// The relief at the nodes of a quadrature over one period of u. Lengths in pitches.
struct Curve {
    std::array<double, 2> translation{0.0, 1.0};  ///< t
    double across_film = 1.0;                     ///< thickness of a film over its length along t
    Eigen::ArrayXd u, weight, x, z, dx, dz;
};

/// Four-point Gauss–Legendre quadrature in `cells` equal parts of [begin, end].
void add_nodes(Curve& curve, double begin, double end, int cells) {
    constexpr std::array<double, 4> kNodes{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                           0.8611363115940526};
    constexpr std::array<double, 4> kWeights{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                             0.3478548451374538};
    auto node = curve.u.size();
    curve.u.conservativeResize(node + 4L * cells);
    curve.weight.conservativeResize(node + 4L * cells);
    const double half = (end - begin) / (2 * cells);
    for (int cell = 0; cell < cells; ++cell)
        for (std::size_t k = 0; k < kNodes.size(); ++k, ++node) {
            curve.u[node] = begin + half * (2 * cell + 1 + kNodes[k]);
            curve.weight[node] = half * kWeights[k];
        }
}

Curve curve_of(const SinusoidalProfile& shape, double pitch_nm, int cells) {
    Curve curve;
    add_nodes(curve, 0.0, 1.0, cells);
    const double half_depth = shape.depth_nm / pitch_nm / 2.0;
    curve.x = curve.u;
    curve.z = half_depth * (2.0 * pi * curve.u).cos();
    curve.dx = Eigen::ArrayXd::Ones(curve.u.size());
    curve.dz = -2.0 * pi * half_depth * (2.0 * pi * curve.u).sin();
    return curve;
}

/// Length of a blazed relief's curve per length of u at its edges, in units of the facet's mean. It is small so that
/// the fluxes, which jump there, are small (adaptive spatial resolution, Granet et al. 2001, JOSA A 18, 2102).
constexpr double kStretchAtEdges = 0.005;

/// The fraction of a period of u that the short facet takes. Fitted: it makes the error smallest (MEASUREMENTS §14).
double short_facet_fraction(double depth) {
    return std::min(0.2 + 0.3 * depth, 0.5);
}

/// The long facet falls from (0, depth) to (1, 0), the short one rises to (1, depth). t bisects their normals, so that
/// films are equally thick on both.
Curve curve_of(const BlazedProfile& shape, double pitch_nm, int cells) {
    Curve curve;
    const double depth = shape.depth_nm / pitch_nm;
    const double blaze = std::atan(depth);
    curve.translation = {-std::sin(pi / 4.0 - blaze / 2.0), std::cos(pi / 4.0 - blaze / 2.0)};
    curve.across_film = std::cos(pi / 4.0 + blaze / 2.0);
    const double fraction = short_facet_fraction(depth);
    const double edge = 1.0 - fraction;
    add_nodes(curve, 0.0, edge, cells - cells / 2);
    add_nodes(curve, edge, 1.0, cells / 2);
    const auto size = curve.u.size();
    curve.x = curve.z = curve.dx = curve.dz = Eigen::ArrayXd::Zero(size);
    for (int i = 0; i < size; ++i) {
        const bool is_long = curve.u[i] < edge;
        const double width = is_long ? 1.0 - fraction : fraction;
        const double turns = (is_long ? curve.u[i] : curve.u[i] - edge) / width;
        const double along = turns - (1.0 - kStretchAtEdges) * std::sin(2.0 * pi * turns) / (2.0 * pi);
        const double slope = (1.0 - (1.0 - kStretchAtEdges) * std::cos(2.0 * pi * turns)) / width;
        curve.x[i] = is_long ? along : 1.0;
        curve.z[i] = depth * (is_long ? 1.0 - along : along);
        curve.dx[i] = is_long ? slope : 0.0;
        curve.dz[i] = is_long ? -depth * slope : depth * slope;
    }
    return curve;
}

/// What all media and polarisations have in common.
struct Geometry {
    Curve curve;
    MatrixXcd waves;              ///< weight · exp(−i α_q u): row q, a column for each node
    MatrixXcd jacobian;           ///< J
    MatrixXcd inverse, coupling;  ///< E, c
};

Geometry geometry_of(Curve curve, const Basis& basis) {
    const auto size = basis.alpha.size();
    Geometry result{.curve = std::move(curve), .waves = {}, .jacobian = {}, .inverse = {}, .coupling = {}};
    const Curve& c = result.curve;
    const Complex minus_i(0.0, -1.0);
    result.waves = ((minus_i * basis.period) * basis.alpha * c.u.matrix().transpose()).array().exp().matrix() *
                   c.weight.matrix().cast<Complex>().asDiagonal();
    const Eigen::ArrayXd jacobian = c.dx * c.translation[1] - c.dz * c.translation[0];
    const Eigen::ArrayXd dot = c.dx * c.translation[0] + c.dz * c.translation[1];
    // Coefficients of J and b from −(size − 1) to size − 1.
    MatrixXcd coefficients(2 * size - 1, 2);
    for (int i = 0; i < 2 * size - 1; ++i) {
        const VectorXcd wave = (minus_i * (2.0 * pi * (i - static_cast<double>(size) + 1.0)) * c.u).exp() * c.weight;
        coefficients(i, 0) = wave.cwiseProduct(jacobian.matrix().cast<Complex>()).sum();
        coefficients(i, 1) = wave.cwiseProduct(dot.matrix().cast<Complex>()).sum();
    }
    MatrixXcd b(size, size);
    result.jacobian.resize(size, size);
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            result.jacobian(row, column) = coefficients(row - column + size - 1, 0);
            b(row, column) = coefficients(row - column + size - 1, 1);
        }
    const MatrixXcd ratio = result.jacobian.partialPivLu().solve(b).adjoint();  // b J⁻¹: both are Hermitian
    result.inverse = (result.jacobian + ratio * b).inverse();
    result.coupling = result.inverse * ratio;
    return result;
}

/// A plane wave (α, γ) on the relief, per pitch: its field, and its flux.
void plane_wave(const Geometry& geometry, const Basis& basis, double alpha, double gamma, Eigen::Ref<VectorXcd> field,
                Eigen::Ref<VectorXcd> flux) {
    const Curve& c = geometry.curve;
    const Eigen::ArrayXcd wave = (Complex(0.0, basis.period) * (alpha * c.x + gamma * c.z)).exp();
    field = geometry.waves * wave.matrix();
    flux = geometry.waves * (wave * (gamma * c.dx - alpha * c.dz)).matrix();
}

/// The modes of a medium. `thickness` along t.
Modes medium(const Geometry& geometry, const Basis& basis, Complex index, double thickness) {
    const auto size = basis.alpha.size();
    const VectorXcd alpha = basis.alpha.cast<Complex>();
    MatrixXcd matrix(2 * size, 2 * size);
    matrix.topLeftCorner(size, size) = geometry.coupling * alpha.asDiagonal();
    matrix.topRightCorner(size, size) = geometry.inverse;
    matrix.bottomLeftCorner(size, size) =
        index * index * geometry.jacobian - alpha.asDiagonal() * geometry.inverse * alpha.asDiagonal();
    matrix.bottomRightCorner(size, size) = alpha.asDiagonal() * geometry.coupling.adjoint();
    const Eigen::ComplexEigenSolver<MatrixXcd> solver(matrix);
    const VectorXcd& values = solver.eigenvalues();
    // The modes that decay upward come first, then those that propagate, then those that decay downward.
    std::vector<int> order(static_cast<std::size_t>(2 * size));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return values[a].imag() > values[b].imag(); });
    Modes modes;
    for (MatrixXcd* part : {&modes.field_up, &modes.flux_up, &modes.field_down, &modes.flux_down})
        part->resize(size, size);
    modes.across_up.resize(size);
    modes.across_down.resize(size);
    for (int i = 0; i < size; ++i) {
        const auto up = solver.eigenvectors().col(order[static_cast<std::size_t>(i)]);
        const auto down = solver.eigenvectors().col(order[static_cast<std::size_t>(2 * size - 1 - i)]);
        modes.field_up.col(i) = up.head(size);
        modes.flux_up.col(i) = up.tail(size);
        modes.field_down.col(i) = down.head(size);
        modes.flux_down.col(i) = down.tail(size);
        modes.across_up[i] = std::exp(Complex(0.0, thickness) * values[order[static_cast<std::size_t>(i)]]);
        modes.across_down[i] =
            std::exp(Complex(0.0, -thickness) * values[order[static_cast<std::size_t>(2 * size - 1 - i)]]);
    }
    return modes;
}

}  // namespace

double largest_stretch(const SinusoidalProfile& shape, double pitch_nm) {
    return std::hypot(1.0, pi * shape.depth_nm / pitch_nm);
}

double largest_stretch(const BlazedProfile& shape, double pitch_nm) {
    const double depth = shape.depth_nm / pitch_nm;
    return 2.0 *
           std::max(std::hypot(1.0, depth) / (1.0 - short_facet_fraction(depth)), depth / short_facet_fraction(depth));
}

Stack translated_stack(const Relief& relief, Complex substrate, const Basis& basis) {
    const auto size = static_cast<int>(basis.alpha.size());
    const auto* blazed = std::get_if<BlazedProfile>(&relief.shape);
    const int cells = 4 * size;
    const Geometry geometry =
        geometry_of(blazed ? curve_of(*blazed, relief.pitch_nm, cells)
                           : curve_of(std::get<SinusoidalProfile>(relief.shape), relief.pitch_nm, cells),
                    basis);
    Stack stack;
    // Exact plane waves take the place of the modes that propagate, which may be mixtures of plane waves.
    const Propagating below = propagating(basis, substrate);
    const Propagating above = propagating(basis, relief.ambient_ior);
    stack.down = size - static_cast<int>(below.gamma.size());
    stack.up = size - static_cast<int>(above.gamma.size());

    std::vector<Modes> modes;
    std::vector<Complex> permittivities;
    modes.push_back(medium(geometry, basis, substrate, 0.0));
    permittivities.push_back(substrate * substrate);
    for (int i = 0; i < below.gamma.size(); ++i)
        plane_wave(geometry, basis, basis.alpha[below.first + i], -below.gamma[i],
                   modes[0].field_down.col(stack.down + i), modes[0].flux_down.col(stack.down + i));
    for (const DielectricFilm& film : relief.films) {
        modes.push_back(medium(geometry, basis, film.ior,
                               2.0 * pi * film.thickness_nm / basis.wavelength_nm / geometry.curve.across_film));
        permittivities.emplace_back(film.ior * film.ior);
    }
    Modes top = medium(geometry, basis, relief.ambient_ior, 0.0);
    top.field_down.resize(size, above.gamma.size());
    top.flux_down.resize(size, above.gamma.size());
    for (int i = 0; i < above.gamma.size(); ++i) {
        const double alpha = basis.alpha[above.first + i];
        plane_wave(geometry, basis, alpha, above.gamma[i], top.field_up.col(stack.up + i),
                   top.flux_up.col(stack.up + i));
        plane_wave(geometry, basis, alpha, -above.gamma[i], top.field_down.col(i), top.flux_down.col(i));
    }
    modes.push_back(std::move(top));
    permittivities.emplace_back(relief.ambient_ior * relief.ambient_ior);

    stack.modes[static_cast<int>(Polarisation::TE)] = modes;
    for (std::size_t i = 0; i < modes.size(); ++i) {
        modes[i].flux_up /= permittivities[i];
        modes[i].flux_down /= permittivities[i];
    }
    stack.modes[static_cast<int>(Polarisation::TM)] = std::move(modes);
    return stack;
}

}  // namespace rowland::diffraction
