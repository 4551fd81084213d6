#pragma once

#include <cmath>
#include <variant>

namespace rowland::diffraction {

/// The paper's case: light scatters evenly along the grooves, D_h = ½.
struct FlatLobe {};

/// D_h = Normal(s_h + v_h; 0, sigma) / erf(1/(sigma √2)): a pressed disc or foil. Tends to ½ as sigma grows.
struct GaussianLobe {
    double sigma = 0.2;  ///< > 0, in units of a direction cosine
};

/// Stam's compact disc (Stam 1999, Diffraction shaders): pits of one length, Poisson-distributed along the track.
/// D_h = κ·G + (1−κ)·(ℓ/λ) sinc²(ℓ (s_h + v_h)/λ), G the normalised Gaussian of kCoherentSigma.
struct PitsLobe {
    double length_nm = 850.0;  ///< ℓ > 0
    double coherent = 0.3;     ///< κ in [0, 1]: the fraction of the light that the track reflects as if unbroken
};

/// σ of the coherent part of PitsLobe.
inline constexpr double kCoherentSigma = 0.02;

using GrooveLobe = std::variant<FlatLobe, GaussianLobe, PitsLobe>;

/// D_h: how light spreads along the grooves, per unit of s_h + v_h ∈ [−2, 2]. Even. It integrates to 1 over [−1, 1]
/// (for pits over all real numbers, so that at most λ/(π²ℓ) lies outside), and to no more over any interval of length
/// 2: a lobe never adds power.
class LobeDensity {
 public:
    /// Only PitsLobe depends on the wavelength.
    LobeDensity(const GrooveLobe& lobe, double wavelength_nm);

    double operator()(double sum_h) const {
        double density = constant_;
        if (peak_ != 0.0) {
            const double z = sum_h * inverse_sigma_;
            density += peak_ * std::exp(-0.5 * z * z);
        }
        if (pit_peak_ != 0.0) density += pits(sum_h);
        return density;
    }

 private:
    void add_gaussian(double sigma, double fraction);
    double pits(double sum_h) const;

    double constant_ = 0.0;
    double peak_ = 0.0;
    double inverse_sigma_ = 0.0;
    double pit_peak_ = 0.0;
    double pit_length_over_wavelength_ = 0.0;  ///< ℓ/λ
};

/// D_h at one value of s_h + v_h. For many values of one lobe and wavelength, keep a LobeDensity.
double lobe_density(const GrooveLobe& lobe, double sum_h, double wavelength_nm);

/// The lengths of a lobe that a quadrature must resolve, in s_h + v_h. All are at most 2, the whole domain.
struct LobeExtent {
    double half_width = 2.0;         ///< beyond it D_h is below 1e-15 of its peak
    double core_half_width = 2.0;    ///< the narrowest part's: split the quadrature there
    double feature_size = 2.0;       ///< over which D_h bends at visible wavelengths: the step must resolve it
    double tail_feature_size = 2.0;  ///< the same beyond the core
};
LobeExtent lobe_extent(const GrooveLobe& lobe);

/// True if D_h is constant: the radiance then depends on v_g, not on v_h.
bool is_flat(const GrooveLobe& lobe);

}  // namespace rowland::diffraction
