#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/colour/light_spectra.h"
#include "engine/lighting/sh_light.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

struct SpikeSettings {
    int bands = 5;   ///< n: n² coefficients per spike, 1 ≤ n ≤ 32
    int spikes = 4;  ///< K ≥ 1
    /// Weighs wavelengths against each other when they are shared out among the spikes; the light itself stays outside.
    colour::Illuminant illuminant = colour::d65();
};

/// One view's diffraction term as K delta functions in wavelength (the composite model's spiky part).
struct SpikeSet {
    int bands = 0;
    std::vector<double> wavelengths_nm;  ///< K, ascending, in [380, 780]
    std::vector<double> coefficients;    ///< K·n², spike by spike: c_k,i in nm
};

/// Bakes the spikes of any number of views of one grating; holds what does not depend on the view.
class SpikeBaker {
 public:
    /// Throws Error (input) for fewer than kManyGrooves grooves.
    SpikeBaker(const Grating& grating, const SpikeSettings& settings);

    /// As bake_spikes(). May be called from many threads.
    SpikeSet bake(double v_g, double v_h) const;

 private:
    ViewSpectrum spectrum_;
    int spikes_;
    colour::Illuminant illuminant_;
    std::vector<double> sensitivity_;  ///< q at every nanometre
};

/// The spikes of the view with tangent-frame components v_g, v_h (PHYSICS §6 "Spikes, exactly"): K wavelength intervals
/// of equal ∫w, w = ‖c(v,λ)‖ q, q = S (x̄+ȳ+z̄); λ_k the w-mean wavelength of interval k, c_k,i = ∫_k c_i q dλ / q(λ_k).
/// Continuous in the view; where no order is visible the coefficients are 0 and the wavelengths those of w = q.
SpikeSet bake_spikes(const Grating& grating, double v_g, double v_h, const SpikeSettings& settings);

/// XYZ = Σ_k cmf(λ_k) Σ_c E_c(λ_k) Σ_i c_k,i l_i,c. `tangent_light` is the light in the frame (g, h, n); the bands that
/// both have are used.
glm::dvec3 evaluate_spikes(const SpikeSet& spikes, const lighting::ShLight& tangent_light,
                           const colour::LightSpectra& spectra);

}  // namespace rowland::diffraction
