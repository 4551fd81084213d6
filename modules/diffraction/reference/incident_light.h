#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "engine/lighting/probe_image.h"
#include "engine/lighting/sh_light.h"

namespace rowland::diffraction {

/// Light as the reference integrates it. Refers to the probe or the coefficients it is made from, which must outlive
/// it.
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

}  // namespace rowland::diffraction
