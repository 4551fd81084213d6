#pragma once

#include <glm/mat3x3.hpp>
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
    /// The spectrum of the light's white, baked in: light of another spectrum is shown as if it had this one.
    colour::Illuminant illuminant = colour::d65();
};

/// One view's diffraction term as K delta functions in wavelength (the composite model's spiky part). A coefficient
/// holds the spike's tristimulus sum, illuminant included; the paper's holds the BRDF at λ_k. So nothing is divided by
/// the lamp's power at λ_k, which is 0 between the lines of a lamp.
struct SpikeSet {
    int bands = 0;
    std::vector<double> wavelengths_nm;  ///< K, ascending, in [380, 780]
    std::vector<double> coefficients;    ///< K·n², spike by spike: c_k,i, X+Y+Z per unit of white light
};

/// Bakes the spikes of any number of views of one grating.
class SpikeBaker {
 public:
    /// Throws Error (input) for fewer than kManyGrooves grooves.
    SpikeBaker(const Grating& grating, const SpikeSettings& settings);

    /// bake_spikes(). May be called from many threads.
    SpikeSet bake(double v_g, double v_h) const;

 private:
    /// The mean position in nm above 380 or, where the lamp is dark, its brightest wavelength in the interval.
    double visible_wavelength(double mean_position, double begin, double end) const;

    ViewSpectrum spectrum_;
    int spikes_;
    std::vector<double> sensitivity_;  ///< q at every nanometre, per nm
};

/// The spikes of the view with tangent-frame components v_g, v_h (PHYSICS §6 "Spikes, exactly"): K wavelength intervals
/// of equal ∫w, w = ‖c(v,λ)‖ q, q = k_S S (x̄+ȳ+z̄); λ_k the w-mean wavelength of interval k, c_k,i = ∫_k c_i q dλ.
/// Continuous in the view; where no order is visible the coefficients are 0 and the wavelengths those of w = q.
SpikeSet bake_spikes(const Grating& grating, double v_g, double v_h, const SpikeSettings& settings);

/// XYZ of a spike of coefficient 1 under light of each of red, green and blue: cmf_o B_c/(x̄+ȳ+z̄) at λ, RGB in.
glm::dmat3 spike_colour(double wavelength_nm);

/// XYZ = Σ_k spike_colour(λ_k) Σ_i c_k,i l_i. `tangent_light` is the light in the frame (g, h, n); the bands that both
/// have are used.
glm::dvec3 evaluate_spikes(const SpikeSet& spikes, const lighting::ShLight& tangent_light);

}  // namespace rowland::diffraction
