#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "modules/diffraction/model/grating.h"

namespace rowland::inspector {

/// One order of one wavelength in the plane across the grooves.
struct OrderPeak {
    int order = 0;
    double angle_deg = 0.0;  ///< where it leaves; positive toward +g
    double efficiency = 0.0;
    double brdf = 0.0;  ///< at the peak, 1/sr; 0 if the order is not listed
};

/// The diffraction term over the angle of view, for light of one wavelength.
struct AngleCurve {
    std::vector<glm::dvec2> points;  ///< (angle in degrees, BRDF in 1/sr), ascending
    std::vector<OrderPeak> peaks;    ///< the listed orders and the mirror's that leave the surface, ascending
};

/// brdf_energy() (PHYSICS §3) for light from `incidence_deg` and views in the plane across the grooves, both within
/// ±90°: at about `samples` even angles, and around each peak as densely as it is narrow.
AngleCurve angle_curve(const diffraction::Grating& grating, double wavelength_nm, double incidence_deg,
                       int samples = 721);

}  // namespace rowland::inspector
