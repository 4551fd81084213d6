#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "engine/colour/illuminant.h"
#include "modules/diffraction/bake/arc_moments.h"
#include "modules/diffraction/bake/lattice_terms.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// Whether arc moments describe all that a grating sees of a light: grooves of the flat lobe without a cover, whose
/// T(s_n) is no polynomial.
inline bool has_arc_moments(const Grating& grating) {
    return sees_v_g_alone(grating) && !grating.cover;
}

/// The diffraction term of one view as SH coefficients with the wavelengths summed (PHYSICS §5):
/// c_i,o,c(v) = Σ_m ∫ η_m(λ) cmf_o(λ) E_c(λ) C_i(mλ/d − v_g) dλ. This equals d ∫ C_i(a) k_o,c(d(a+v_g)) da, except that
/// the lobe may depend on the wavelength. A lattice takes LatticeTerms.
class TransferTerms {
 public:
    /// Throws as require_many_grooves().
    TransferTerms(const Grating& grating, const colour::LightSpectra& spectra, int bands);

    /// c_i for a view, [i] RGB in, XYZ out; bands² matrices in the frame (g, h, n). The weight is linear between whole
    /// nanometres, as in ColourKernel. Each nanometre above the horizon takes two Gauss–Legendre nodes in the arc's
    /// angle: accurate to 1e-8 for the flat lobe. `pitch_factor` scales the pitch, not the efficiencies; a lattice
    /// ignores it.
    std::vector<glm::dmat3> coefficients(double v_g, double v_h, double pitch_factor = 1.0) const;

    /// The coefficients T_k(v_g) of the 2·bands − 1 arc moments (arc_moments.h), [k]. has_arc_moments() must hold.
    std::vector<glm::dmat3> moments(double v_g, double pitch_factor = 1.0) const;

 private:
    /// Calls use(a, wavelength_nm, weight) for every arc of the quadrature.
    template <typename Use>
    void each_arc(double v_g, double pitch_nm, const Use& use) const;
    /// The weights of one order for a view, one per nanometre.
    std::vector<glm::dmat3> weights(int order, double v_g) const;
    std::vector<glm::dmat3> summed_arcs(double v_g, double v_h, double pitch_factor) const;

    Grating grating_;
    bool by_moments_;
    std::vector<glm::dmat3> observed_;              ///< cmf Eᵀ, one per nanometre
    std::vector<std::vector<glm::dmat3>> weights_;  ///< by order, where they do not depend on the view
    ArcCoefficients arcs_;
    ArcMoments moments_;
    std::optional<LatticeTerms> lattice_;
};

/// Throws Error (input) for fewer than kManyGrooves grooves: baked tables hold for N → ∞.
void require_many_grooves(const Grating& grating);

/// The diffraction term of one view as SH coefficients per wavelength: c_i(v, λ) = Σ_m η_m(λ) C_i(mλ/d − v_g), PHYSICS
/// §5, or of a lattice (13.4), tabulated at every nanometre of the visible range. Holds everything that does not depend
/// on the view.
class ViewSpectrum {
 public:
    /// Throws as require_many_grooves().
    ViewSpectrum(const Grating& grating, int bands);

    /// c_i at wavelength 380 + j nm is [j·bands² + i]; 401·bands² values.
    std::vector<double> coefficients(double v_g, double v_h) const;

    int bands() const { return arcs_.bands(); }
    /// max over λ of Σ_m η_m at normal incidence: the scale of the material's response.
    double largest_efficiency() const { return largest_efficiency_; }

 private:
    Grating grating_;
    std::vector<LatticeOrder> lattice_orders_;
    std::vector<double> efficiencies_;  ///< at normal incidence: order by order, 401 each
    double largest_efficiency_ = 0.0;
    ArcCoefficients arcs_;
};

/// Number of wavelengths: every nanometre from 380 to 780.
inline constexpr std::size_t kWavelengths = colour::kVisibleMax - colour::kVisibleMin + 1;

}  // namespace rowland::diffraction
