#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "modules/diffraction/model/cover.h"
#include "modules/diffraction/model/lobe.h"
#include "modules/diffraction/reference/incident_light.h"

namespace rowland::diffraction {

/// The half circle s_g = a, and the view for which the light on it is integrated.
struct Arc {
    double a = 0.0;              ///< s_g
    double v_h = 0.0;            ///< only the lobe depends on it
    double wavelength_nm = 0.0;  ///< likewise
    double node_offset = 0.5;    ///< position of a panel's node in [0, 1]; ignored by panels of several nodes
    int refinement = 1;          ///< multiplies the number of panels
};

/// The axes (g, h, −n) in place of (g, h, n): directions of the tangent frame mirrored in the surface.
glm::dmat3 mirrored_in_surface(const glm::dmat3& world_to_tangent);

/// The arc profile A_c(a), PHYSICS (2): ½ ∫₀^π L_c(a, r cos t, r sin t) · 2 D_h(r cos t + v_h) · r sin t dt with
/// r = √(1−a²), directions in the tangent frame whose world axes are the rows of `world_to_tangent`. 0 for |a| ≥ 1.
/// With the flat lobe 2 D_h = 1. A cover multiplies the integrand by T(r sin t), PHYSICS (27).
///
/// Of light that a sheet transmits (PHYSICS §12), the axes are mirrored_in_surface().
glm::dvec3 arc_profile(const IncidentLight& light, const glm::dmat3& world_to_tangent, const GrooveLobe& lobe,
                       const Arc& arc, const std::optional<Cover>& cover = std::nullopt);

}  // namespace rowland::diffraction
