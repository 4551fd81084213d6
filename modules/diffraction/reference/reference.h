#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "engine/lighting/probe_image.h"
#include "engine/lighting/sh_light.h"
#include "modules/diffraction/model/frame.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// The yardstick: XYZ of the listed orders of `grating` for every frame (PHYSICS §4), with nothing approximated but by
/// quadrature. Per order and per nanometre the light is integrated along its half circle s_g = mλ/d − v_g at full
/// resolution (bilinear); the step follows the probe's texels and the lobe. Fewer than kManyGrooves grooves are given
/// their true width (profiles but tables, lobes but pits). A table of several incidences is taken at each arc's own,
/// s_g. A view below the horizon is black. All frames must be valid.
///
/// Runs on all cores; the result does not depend on their number. Shares no code with the baked representations.
std::vector<glm::dvec3> reference_radiance(const Grating& grating, const lighting::ProbeImage& probe,
                                           const colour::LightSpectra& spectra, std::span<const Frame> frames);

/// The same under band-limited light.
std::vector<glm::dvec3> reference_radiance(const Grating& grating, const lighting::ShLight& light,
                                           const colour::LightSpectra& spectra, std::span<const Frame> frames);

/// A frame's XYZ with the reference's own error in it.
struct CheckedRadiance {
    glm::dvec3 xyz{0.0};  ///< as reference_radiance() gives it
    double error = 0.0;   ///< ‖XYZ − XYZ at half the steps‖ / ‖XYZ at half the steps‖; 0 where both are black
};

/// The reference at its usual steps and at half of them, along the arcs and in wavelength: where the error is larger
/// than what is compared, the reference is no yardstick (lamps smaller than a texel, a lobe at the horizon). Five times
/// the work of reference_radiance().
std::vector<CheckedRadiance> checked_reference(const Grating& grating, const lighting::ProbeImage& probe,
                                               const colour::LightSpectra& spectra, std::span<const Frame> frames);
std::vector<CheckedRadiance> checked_reference(const Grating& grating, const lighting::ShLight& light,
                                               const colour::LightSpectra& spectra, std::span<const Frame> frames);

}  // namespace rowland::diffraction
