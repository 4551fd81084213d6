#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "engine/lighting/sh_light.h"
#include "modules/diffraction/bake/spike_table.h"
#include "modules/diffraction/model/frame.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::trade {

/// XYZ of every frame by spikes baked for its own view, exactly. Views below the horizon are black.
std::vector<glm::dvec3> evaluate_exact_spikes(const diffraction::Grating& grating,
                                              const diffraction::SpikeSettings& settings,
                                              const lighting::ShLight& light, const colour::LightSpectra& spectra,
                                              std::span<const diffraction::Frame> frames);

/// The same by a view table, as the GPU filters it.
std::vector<glm::dvec3> evaluate_spike_table(const diffraction::SpikeTable& table, const lighting::ShLight& light,
                                             const colour::LightSpectra& spectra,
                                             std::span<const diffraction::Frame> frames);

}  // namespace rowland::trade
