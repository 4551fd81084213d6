#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/model/shading_point.h"
#include "modules/diffraction/reference/incident_light.h"

namespace rowland::diffraction {

/// reference_radiance() of a grating with a lattice, PHYSICS (47): per order and nanometre the light of one direction,
/// s_p = λ (m a* + k b*) − v_p. The step is smaller where 1 nm moves the farthest order by more than the light's
/// panels. `refinement` ≥ 1 divides it.
std::vector<glm::dvec3> lattice_radiance(const Grating& grating, const IncidentLight& light,
                                         const colour::LightSpectra& spectra, std::span<const ShadingPoint> frames,
                                         int refinement);

}  // namespace rowland::diffraction
