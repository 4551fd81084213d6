#pragma once

#include <glm/vec3.hpp>

#include "engine/colour/sampled_spectrum.h"

namespace rowland::colour {

/// The colour matching functions (x̄, ȳ, z̄) of the CIE 1931 2° standard observer: the 1 nm table, linear between its
/// entries, 0 outside 360–830 nm.
glm::dvec3 cie_xyz(double wavelength_nm);

}  // namespace rowland::colour
