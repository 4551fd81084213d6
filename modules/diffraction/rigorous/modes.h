#pragma once

// The parts of the solver: private to this folder. All lengths are in units of λ/2π and all wave vector components in
// units of 2π/λ. x is along g, z along n. A field is a vector of coefficients over the basis functions
// exp(i α_q u), α_q = α_0 + q λ/d. Time dependence exp(−iωt).

#include <Eigen/Core>
#include <complex>
#include <span>
#include <vector>

#include "modules/diffraction/rigorous/relief.h"

namespace rowland::diffraction {

enum class Polarisation { TE, TM };  ///< E, or H, along the grooves

/// The modes of a medium or a slice between two surfaces. A mode is a column of the field (E or H along the grooves)
/// and of its flux through the surfaces (−i ∂F/∂n of TE, divided by ε of TM): both are continuous there.
struct Modes {
    Eigen::MatrixXcd field_up, flux_up, field_down, flux_down;
    Eigen::VectorXcd across_up, across_down;  ///< what a mode is multiplied with across the slice; |.| ≤ 1
};

/// Amplitudes of the modes that leave a stack, a column for each incident mode.
struct Scattered {
    Eigen::MatrixXcd up;    ///< in the medium on top
    Eigen::MatrixXcd down;  ///< in the substrate
};

/// Scattering by the stack: substrate (only modes down), slices from the bottom up, top medium, whose modes down are
/// the incident ones. By recursion of the admittance matrix, in which no growing exponential occurs (Li 1996, JOSA A
/// 13, 1024; Popov & Nevière 2001).
Scattered scatter(std::span<const Modes> stack, bool transmits);

/// The basis for one wavelength and one s_g modulo λ/d.
struct Basis {
    double wavelength_nm = 0.0;
    double period = 0.0;    ///< 2π d/λ
    Eigen::VectorXd alpha;  ///< α_q, ascending, in steps of λ/d
};

/// A medium's plane waves that carry power: indices of the basis from `first` on.
struct Propagating {
    int first = 0;
    Eigen::VectorXd gamma;  ///< γ = √(n² − α²) > 0
};
Propagating propagating(const Basis& basis, std::complex<double> index);

/// √(ε − κ²) with a positive imaginary part, or real and positive; never 0.
std::complex<double> vertical_component(std::complex<double> permittivity, double kappa);

/// The stack of a relief for each polarisation. Those upward modes of the top medium and downward modes of the
/// substrate that propagate are the plane waves of propagating(), in columns from `up` and from `down` on, with
/// amplitudes of E or H.
struct Stack {
    std::vector<Modes> modes[2];  ///< by Polarisation
    int up = 0;                   ///< column of the top medium's first plane wave
    int down = 0;                 ///< column of the substrate's first plane wave
};

/// Largest length of a relief per length of the coordinate u that its fields are expanded over.
double largest_stretch(const LamellarProfile& shape, double pitch_nm);
double largest_stretch(const SinusoidalProfile& shape, double pitch_nm);
double largest_stretch(const BlazedProfile& shape, double pitch_nm);

/// Fourier modal method in a basis with adaptive spatial resolution: lamellar and flat reliefs.
/// Granet 1999, JOSA A 16, 2510; Vallius & Honkanen 2002, Optics Express 10, 24; factorisation of Li 1996, JOSA A 13,
/// 1870.
Stack lamellar_stack(const Relief& relief, std::complex<double> substrate, const Basis& basis);

/// Coordinate-transformation method with oblique translation: sinusoidal and blazed reliefs.
/// Chandezon et al. 1982, J. Opt. Soc. Am. 72, 839; Plumey et al. 1997, JOSA A 14, 610; Li et al. 1999, Appl. Opt. 38,
/// 304.
Stack translated_stack(const Relief& relief, std::complex<double> substrate, const Basis& basis);

}  // namespace rowland::diffraction
