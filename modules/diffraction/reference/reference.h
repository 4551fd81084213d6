#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/colour/illuminant.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/reference/incident_light.h"

namespace rowland::diffraction {

/// XYZ of the orders of a grating with a lattice, without the reflected side of a sheet, PHYSICS (13.2): per order and
/// nanometre the light of one direction, s_p = λ (m a* + k b*) − v_p. The step is smaller where 1 nm moves that
/// direction by more than a panel of the light. `refinement` ≥ 1 divides it.
std::vector<glm::dvec3> lattice_radiance(const Grating& grating, const IncidentLight& light,
                                         const colour::LightSpectra& spectra, std::span<const ShadingPoint> points,
                                         int refinement);

/// The ground truth: XYZ of the listed orders of `grating` for every point, PHYSICS (4.1), exact but for quadrature.
/// Per order and nanometre the light is integrated along its half circle s_g = mλ/d − v_g, from a probe at full
/// resolution (bilinear) or from SH; the step follows the probe's texels and the lobe. Fewer than kManyGrooves grooves
/// have their true width (for all profiles but tables and all lobes but pits). A sheet that transmits shows the light
/// mirrored in its plane, to which what it reflects is added. The orders of a lattice are points, PHYSICS (13.1). A
/// table of several incidences is evaluated at s_g of each arc. A view below the horizon is black. A cover's gloss is
/// not included. All points must be valid, and the grating solved: is_solved().
///
/// Uses all cores; the result does not depend on their number. Shares no code with the baked representations.
std::vector<glm::dvec3> reference_radiance(const Grating& grating, const IncidentLight& light,
                                           const colour::LightSpectra& spectra, std::span<const ShadingPoint> points);

/// A point's XYZ and an estimate of the reference's own error.
struct CheckedRadiance {
    glm::dvec3 xyz{0.0};  ///< as reference_radiance() computes it
    double error = 0.0;   ///< ‖XYZ − XYZ at half the steps‖ / ‖XYZ at half the steps‖; 0 where both are black
};

/// reference_radiance() at its steps and at half of them, along the arcs and in wavelength. Where `error` is larger
/// than the difference under test, the reference cannot judge it (lamps smaller than a texel, a lobe at the horizon).
/// Costs five times as much as reference_radiance().
std::vector<CheckedRadiance> checked_reference(const Grating& grating, const IncidentLight& light,
                                               const colour::LightSpectra& spectra,
                                               std::span<const ShadingPoint> points);

}  // namespace rowland::diffraction
