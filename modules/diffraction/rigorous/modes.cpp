#include "modules/diffraction/rigorous/modes.h"

#include <Eigen/LU>
#include <cmath>

namespace rowland::diffraction {

using Eigen::MatrixXcd;

std::complex<double> vertical_component(std::complex<double> permittivity, double kappa) {
    // Not 0: at a cut-off the modes up and down would be one, and a film's modes incomplete.
    const std::complex<double> squared = permittivity - kappa * kappa;
    const std::complex<double> gamma = std::sqrt(std::abs(squared) < 1e-12 ? 1e-12 : squared);
    return gamma.imag() < 0.0 ? -gamma : gamma;
}

Propagating propagating(const Basis& basis, std::complex<double> index) {
    Propagating result;
    if (index.imag() != 0.0) return result;
    std::vector<double> gammas;
    for (int q = 0; q < basis.alpha.size(); ++q) {
        const double squared = index.real() * index.real() - basis.alpha[q] * basis.alpha[q];
        if (squared <= 1e-12) continue;
        if (gammas.empty()) result.first = q;
        gammas.push_back(std::sqrt(squared));
    }
    result.gamma = Eigen::Map<const Eigen::VectorXd>(gammas.data(), static_cast<Eigen::Index>(gammas.size()));
    return result;
}

Scattered scatter(std::span<const Modes> stack, bool transmits) {
    // Field and flux at the top of the slices so far, a column for each downward mode of the uppermost one.
    MatrixXcd field = stack.front().field_down;
    MatrixXcd flux = stack.front().flux_down;
    Scattered result;
    for (std::size_t i = 1; i < stack.size(); ++i) {
        const Modes& modes = stack[i];
        // flux = Y field: Yᵀ = fieldᵀ⁻¹ fluxᵀ.
        const MatrixXcd admittance = field.transpose().partialPivLu().solve(flux.transpose()).transpose();
        const MatrixXcd reflected = (modes.flux_up - admittance * modes.field_up)
                                        .partialPivLu()
                                        .solve(admittance * modes.field_down - modes.flux_down);
        if (transmits) {
            const MatrixXcd entering = field.partialPivLu().solve(modes.field_down + modes.field_up * reflected);
            result.down = i == 1 ? entering : result.down * entering;
        }
        if (i + 1 == stack.size()) {
            result.up = reflected;
            break;
        }
        if (transmits) result.down = result.down * modes.across_down.asDiagonal();
        const MatrixXcd across = modes.across_up.asDiagonal() * reflected * modes.across_down.asDiagonal();
        field = modes.field_down + modes.field_up * across;
        flux = modes.flux_down + modes.flux_up * across;
    }
    return result;
}

}  // namespace rowland::diffraction
