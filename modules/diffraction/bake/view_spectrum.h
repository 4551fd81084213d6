#pragma once

#include <vector>

#include "engine/colour/illuminant.h"
#include "modules/diffraction/bake/arc_coefficients.h"
#include "modules/diffraction/bake/lattice_terms.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// Throws Error (input) for fewer than kManyGrooves grooves: baked tables hold for N → ∞.
void require_many_grooves(const Grating& grating);

/// The diffraction term of one view as SH coefficients per wavelength: c_i(v, λ) = Σ_m η_m(λ) C_i(mλ/d − v_g), PHYSICS
/// §5, or of a lattice (51), tabulated at every nanometre of the visible range. Holds everything that does not depend
/// on the view.
class ViewSpectrum {
 public:
    /// Throws as require_many_grooves().
    ViewSpectrum(const Grating& grating, int bands);

    /// c_i at wavelength 380 + j nm is [j·bands² + i]; 401·bands² values.
    std::vector<double> coefficients(double v_g, double v_h) const;

    int bands() const { return arcs_.bands(); }
    /// max over λ of Σ_m η_m: the scale of the material's response.
    double largest_efficiency() const { return largest_efficiency_; }

 private:
    double pitch_nm_;
    std::vector<LatticeOrder> lattice_orders_;
    std::vector<int> orders_;
    std::vector<double> efficiencies_;  ///< order by order, 401 each
    double largest_efficiency_ = 0.0;
    std::optional<Cover> cover_;
    ArcCoefficients arcs_;
};

/// Number of wavelengths: every nanometre from 380 to 780.
inline constexpr std::size_t kWavelengths = colour::kVisibleMax - colour::kVisibleMin + 1;

}  // namespace rowland::diffraction
