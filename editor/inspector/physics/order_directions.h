#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "modules/diffraction/model/grating.h"

namespace rowland::inspector {

/// Where one wavelength of an order leaves, seen from above: components of the unit vector across and along the
/// grooves.
struct OrderSpot {
    double wavelength_nm = 0.0;
    double v_g = 0.0;
    double v_h = 0.0;
};

struct OrderTrace {
    int order = 0;
    std::vector<OrderSpot> spots;  ///< ascending wavelengths; only those that leave the surface
};

/// Where the listed orders and the mirror's send light from the direction `s` of the tangent frame (g, h, n), s_n > 0:
/// d (s_g + v_g) = mλ, s_h + v_h = 0 (PHYSICS §2), every `step_nm` from 380 to 780 nm. Orders that leave nowhere are
/// not there.
std::vector<OrderTrace> order_directions(const diffraction::Grating& grating, const glm::dvec3& s, int step_nm = 5);

}  // namespace rowland::inspector
