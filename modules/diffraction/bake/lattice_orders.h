#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// An order of a lattice: wavelength λ lies at u = λ u_per_nm.
struct LatticeOrder {
    glm::dvec2 u_per_nm{0.0};
    std::vector<double> efficiency;  ///< R η at every nanometre of the visible range
};

/// The orders of a grating with a lattice that some pair of directions sees, but (0, 0) and those darker than 1e-9.
std::vector<LatticeOrder> lattice_orders(const Grating& grating);

/// The same in the frame that a point is shaded in: of a sheet that transmits, h is reversed (PHYSICS §13).
std::vector<LatticeOrder> shaded_lattice_orders(const Grating& grating);

}  // namespace rowland::diffraction
