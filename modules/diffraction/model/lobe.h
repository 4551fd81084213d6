#pragma once

#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

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

/// σ of the coherent part of PitsLobe, and of each order of PitSequenceLobe unless it says otherwise.
inline constexpr double kCoherentSigma = 0.02;

/// The most spacings of a PitSequenceLobe.
inline constexpr std::size_t kMostPitSpacings = 16;

/// A pressed disc as gratings along the track, of several spacings b at once (Sun, Fracchia, Drew & Calvert 2000,
/// Rendering iridescent colors of optical disks). These spacings are those of Egholm & Christensen 2006, Rendering
/// compact disks and other diffractive surfaces illuminated by linear light sources. b is a pit and a land of the same
/// length. D_h is the mean over b of Σ_m C_m G(s_h + v_h − mλ/b), PHYSICS (3.5): C_0 = κ, C_m = (1−κ) (2/(πm))² for odd
/// m and 0 for even m ≠ 0, G the normalised Gaussian of this sigma.
struct PitSequenceLobe {
    std::vector<double> spacings_nm{900.0,  1200.0, 1500.0, 1800.0, 2100.0,
                                    2400.0, 2700.0, 3000.0, 3300.0};  ///< b > 0, ascending, of equal weights
    double coherent = 0.3;                                            ///< κ in [0, 1], as of PitsLobe
    double sigma = kCoherentSigma;  ///< > 0: the track is coherent over a finite length
};

using GrooveLobe = std::variant<FlatLobe, GaussianLobe, PitsLobe, PitSequenceLobe>;

/// D_h: how light spreads along the grooves, per unit of s_h + v_h ∈ [−2, 2]. Even. It integrates to 1 over [−1, 1]
/// (for pits and pit sequences over all real numbers: of pits at most λ/(π²ℓ) lies outside, of a pit sequence the
/// orders beyond ±1), and to no more over any interval of length 2: a lobe never adds power.
class LobeDensity {
 public:
    /// The wavelength matters if depends_on_wavelength().
    LobeDensity(const GrooveLobe& lobe, double wavelength_nm);

    double operator()(double sum_h) const {
        double density = constant_;
        if (peak_ != 0.0) {
            const double z = sum_h * inverse_sigma_;
            density += peak_ * std::exp(-0.5 * z * z);
        }
        if (pit_peak_ != 0.0) density += pits(sum_h);
        if (order_peak_ != 0.0) density += pit_sequence(sum_h);
        return density;
    }

 private:
    void add_gaussian(double sigma, double fraction);
    double pits(double sum_h) const;
    double pit_sequence(double sum_h) const;

    double constant_ = 0.0;
    double peak_ = 0.0;
    double inverse_sigma_ = 0.0;
    double pit_peak_ = 0.0;
    double pit_length_over_wavelength_ = 0.0;           ///< ℓ/λ
    double order_peak_ = 0.0;                           ///< of order ±1 of one spacing
    double order_half_width_ = 0.0;                     ///< beyond it an order is below 1e-15 of its peak
    std::vector<double> pit_spacings_over_wavelength_;  ///< b/λ
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

/// An order of a PitSequenceLobe: power · G(s_h + v_h − centre).
struct PitOrder {
    double centre = 0.0;
    double power = 0.0;
};

/// The orders of all spacings whose centres are within ±farthest.
std::vector<PitOrder> pit_orders(const PitSequenceLobe& lobe, double wavelength_nm, double farthest);

/// C_m/(1 − κ) of PitSequenceLobe for odd m: a lamellar relief's efficiency at a duty of ½.
double pit_order_power(int order);

/// True if D_h is constant: the radiance then depends on v_g, not on v_h.
bool is_flat(const GrooveLobe& lobe);

/// True if D_h is another one at another wavelength.
bool depends_on_wavelength(const GrooveLobe& lobe);

}  // namespace rowland::diffraction
