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

using GrooveLobe = std::variant<FlatLobe, GaussianLobe>;

/// D_h: how light spreads along the grooves, per unit of s_h + v_h ∈ [−2, 2]. It integrates to 1 over [−1, 1] and is
/// even.
class LobeDensity {
 public:
    /// The wavelength is for lobes that depend on it.
    LobeDensity(const GrooveLobe& lobe, double wavelength_nm);

    double operator()(double sum_h) const {
        if (peak_ == 0.0) return constant_;
        const double z = sum_h * inverse_sigma_;
        return constant_ + peak_ * std::exp(-0.5 * z * z);
    }

 private:
    double constant_ = 0.0;
    double peak_ = 0.0;
    double inverse_sigma_ = 0.0;
};

/// D_h at one place. For many places of one lobe and wavelength, keep a LobeDensity.
double lobe_density(const GrooveLobe& lobe, double sum_h, double wavelength_nm);

/// |s_h + v_h| beyond which D_h is below 1e-15 of its peak; 2, the whole domain, for a lobe without an end.
double lobe_half_width(const GrooveLobe& lobe);

/// Distance in s_h over which D_h bends: a quadrature's step must resolve it. 2 for the flat lobe.
double lobe_feature_size(const GrooveLobe& lobe);

/// True if D_h is the same for every s_h + v_h, so that the view matters through v_g alone.
bool is_flat(const GrooveLobe& lobe);

}  // namespace rowland::diffraction
