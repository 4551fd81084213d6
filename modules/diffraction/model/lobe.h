#pragma once

#include <cmath>
#include <variant>

namespace rowland::diffraction {

/// The paper's free case: light scatters evenly along the grooves, D_h = ½.
struct FlatLobe {};

/// D_h = Normal(s_h + v_h; 0, sigma) / erf(1/(sigma √2)): a pressed disc or foil. Tends to ½ as sigma grows.
struct GaussianLobe {
    double sigma = 0.2;  ///< > 0, in units of a direction cosine
};

/// Stam's compact disc (Stam 1999, Diffraction shaders): pits of one length, Poisson-distributed along the track.
/// D_h = κ·G + (1−κ)·(ℓ/λ) sinc²(ℓ (s_h + v_h)/λ), G the normalised Gaussian of kCoherentSigma.
struct PitsLobe {
    double length_nm = 850.0;  ///< ℓ > 0
    double coherent = 0.3;     ///< κ in [0, 1]: the share that the track reflects as if it were unbroken
};

/// σ of the coherent share of PitsLobe.
inline constexpr double kCoherentSigma = 0.02;

using GrooveLobe = std::variant<FlatLobe, GaussianLobe, PitsLobe>;

/// D_h: how light spreads along the grooves, per unit of s_h + v_h ∈ [−2, 2]. Even. It integrates to 1 over [−1, 1]
/// (pits: over all sums, so that a share of λ/(π²ℓ) or less is lost beyond), and to no more over any stretch of length
/// 2: a lobe never adds power.
class LobeDensity {
 public:
    /// The wavelength is for lobes that depend on it.
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
    void add_gaussian(double sigma, double share);
    double pits(double sum_h) const;

    double constant_ = 0.0;
    double peak_ = 0.0;
    double inverse_sigma_ = 0.0;
    double pit_peak_ = 0.0;
    double pit_wavelengths_ = 0.0;  ///< ℓ/λ
};

/// D_h at one place. For many places of one lobe and wavelength, keep a LobeDensity.
double lobe_density(const GrooveLobe& lobe, double sum_h, double wavelength_nm);

/// |s_h + v_h| beyond which D_h is below 1e-15 of its peak; 2, the whole domain, for a lobe without an end.
double lobe_half_width(const GrooveLobe& lobe);

/// |s_h + v_h| beyond which the lobe's narrowest part is over: a quadrature splits there. At most lobe_half_width().
double lobe_core_half_width(const GrooveLobe& lobe);

/// Distance in s_h over which D_h bends at visible wavelengths: a quadrature's step must resolve it. 2 for the flat
/// lobe.
double lobe_feature_size(const GrooveLobe& lobe);

/// The same beyond the core.
double lobe_tail_feature_size(const GrooveLobe& lobe);

/// True if D_h is the same for every s_h + v_h, so that the view matters through v_g alone.
bool is_flat(const GrooveLobe& lobe);

}  // namespace rowland::diffraction
