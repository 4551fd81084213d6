#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/lighting/probe_image.h"
#include "engine/lighting/sh_light.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/model/lobe.h"

namespace rowland::diffraction {

/// Light as the reference integrates it. It refers to the probe or the coefficients that it is made from, which must
/// outlive it.
struct IncidentLight {
    /// A probe at full resolution. Bilinear light has kinks at every texel, so panels are shorter than a texel and have
    /// one node each.
    IncidentLight(const lighting::ProbeImage& probe);
    /// Band-limited light is smooth: a few long panels of many nodes are exact to rounding.
    IncidentLight(const lighting::ShLight& light);

    std::function<glm::dvec3(const glm::dvec3&)> radiance;  ///< linear RGB from a unit vector in world axes
    double panel_angle = 0.0;                               ///< length of a quadrature panel along an arc, in radians
    int nodes_per_panel = 1;                                ///< Gauss–Legendre nodes
};

/// The half circle s_g = a, and the view for which the light on it is integrated.
struct Arc {
    double a = 0.0;              ///< s_g
    double v_h = 0.0;            ///< only the lobe depends on it
    double wavelength_nm = 0.0;  ///< likewise
    double node_offset = 0.5;    ///< position of a panel's node in [0, 1]; ignored by panels of several nodes
    int refinement = 1;          ///< multiplies the number of panels
};

/// The axes (g, h, −n) in place of (g, h, n): the tangent frame mirrored in the surface.
glm::dmat3 mirrored_in_surface(const glm::dmat3& world_to_tangent);

/// The arc profile A_c(a), PHYSICS (2): ½ ∫₀^π L_c(a, r cos t, r sin t) · 2 D_h(r cos t + v_h) · r sin t dt with
/// r = √(1−a²), directions in the tangent frame whose world axes are the rows of `world_to_tangent`. 0 for |a| ≥ 1.
/// With the flat lobe 2 D_h = 1. A cover multiplies the integrand by T(r sin t), PHYSICS (10.2).
///
/// Of light that a sheet transmits (PHYSICS §12), the axes are mirrored_in_surface().
glm::dvec3 arc_profile(const IncidentLight& light, const glm::dmat3& world_to_tangent, const GrooveLobe& lobe,
                       const Arc& arc, const std::optional<Cover>& cover = std::nullopt);

}  // namespace rowland::diffraction
