#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "modules/diffraction/model/lobe.h"
#include "modules/diffraction/reference/incident_light.h"

namespace rowland::diffraction {

/// The arc profile A_c(a) of PHYSICS §4: ½ ∫₀^π L_c(a, r cos t, r sin t) · 2 D_h(r cos t + v_h) · r sin t dt with
/// r = √(1−a²), directions in the tangent frame whose world axes are the rows of `world_to_tangent`. 0 for |a| ≥ 1.
/// With the flat lobe 2 D_h = 1.
struct Arc {
    double a = 0.0;              ///< s_g
    double v_h = 0.0;            ///< the view, for the lobe
    double wavelength_nm = 0.0;  ///< for the lobe
    double node_offset = 0.5;    ///< where a panel's only node lies, in [0, 1]; light of many-node panels ignores it
    int refinement = 1;          ///< as many times more panels than usual
};
glm::dvec3 arc_profile(const IncidentLight& light, const glm::dmat3& world_to_tangent, const GrooveLobe& lobe,
                       const Arc& arc);

}  // namespace rowland::diffraction
