#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/core/byte_stream.h"
#include "engine/lighting/sh_light.h"
#include "modules/diffraction/bake/packed_texels.h"
#include "modules/diffraction/bake/view_mapping.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/descriptor.h"
#include "modules/diffraction/representations/point_shader.h"

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

/// Spikes tabulated over the views of the upper hemisphere, laid out as a 2D texture array (the paper's step 4 and 5).
///
/// Layer k·L + j, L = ⌈(bands²+1)/4⌉, holds entries 4j..4j+3 of spike k's list [c_0 … c_{n²−1}, (λ_k − 380)/400, 0 …].
struct SpikeTable : PackedTexels {
    int bands = 0;
    int spikes = 0;
    ViewGrid grid;

    int layers_per_spike() const { return (bands * bands + 1 + 3) / 4; }
    int layers() const { return spikes * layers_per_spike(); }
};

struct SpikeTableSettings {
    SpikeSettings spikes;
    ViewGrid grid{};  ///< one-dimensional: flat lobe only
    Storage storage = Storage::Unorm16;

    static const RepresentationInfo& info();
    static std::optional<Refusal> refusal(const SettingValues& values, const Grating& grating);
    static SpikeTableSettings from(const SettingValues& values, const Grating& grating);
    void set_illuminant(const colour::Illuminant& white) { spikes.illuminant = white; }
};

/// Bakes the spikes of every node. Throws Error (input) for fewer than kManyGrooves grooves, and for a one-dimensional
/// mapping of a lobe that is not flat. The bytes do not depend on the number of threads.
SpikeTable bake(const Grating& grating, const SpikeTableSettings& settings);

/// The spikes of the tangent-frame view (v_g, v_h, v_n), as GL_LINEAR filters at the coordinates of view_mapping.h.
/// Coefficients are 0 for a view below the horizon (v_n ≤ 0).
SpikeSet sample(const SpikeTable& table, double v_g, double v_h, double v_n);

/// XYZ of the tangent-frame view: evaluate_spikes() of sample().
inline glm::dvec3 evaluate(const SpikeTable& table, const lighting::ShLight& tangent_light, const glm::dvec3& view) {
    return evaluate_spikes(sample(table, view.x, view.y, view.z), tangent_light);
}

void write(const SpikeTable& table, ByteWriter& writer);

/// Inverse of write(). Throws Error (input) naming the offset for invalid bytes.
SpikeTable read_spike_table(ByteReader& reader);

/// Required by representation.h.
SpikeTable read(ByteReader& reader, const SpikeTableSettings& settings);
ShadingCost cost(const SpikeTable& table);
Facts facts(const SpikeTable& table);

}  // namespace rowland::diffraction
