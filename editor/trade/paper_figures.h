#pragma once

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include "modules/diffraction/asset/cooked_material.h"

namespace rowland::trade {

struct Curve {
    std::vector<double> x;
    std::vector<double> y;
};

/// Fig. 2 of Lindsay & Agu 2006: diffraction varies faster than interference.
struct Figure2 {
    Curve diffraction;   ///< x: half the phase between neighbouring grooves, −π to π; y: 1 at the highest peak
    Curve interference;  ///< of a thin film over the same phase; y likewise
    Curve peak;          ///< one order: x in degrees of view from its peak, y 1 at the peak
    double peak_width_degrees = 0.0;  ///< between the half heights of `peak`
};

/// The curves of a slit grating (for other profiles, of slits of half the pitch) at normal incidence, at its first
/// order for 550 nm; the film is two-beam interference of a soap film.
Figure2 figure_2(const diffraction::Grating& grating);

/// The figures of Lindsay & Agu 2006 with this material, as the report's script reads them: "figure_2".
/// With `gpu`, for a flat lobe without a lattice, a cover or transmission, also what is drawn in frames of `size`
/// pixels:
/// - "figure_3": frames per second against the number of lights, light by light and by SH
/// - "figure_6": pictures of one and of several lights, light by light and by SH
/// - "rates": the frame rates of section 5 on the disc of 25 000 vertices
/// `paper`: a material in the paper's setting.
nlohmann::ordered_json paper_evidence(const diffraction::CookedMaterial& paper, glm::ivec2 size, bool gpu);

}  // namespace rowland::trade
