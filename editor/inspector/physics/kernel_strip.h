#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "modules/diffraction/model/colour_kernel.h"

namespace rowland::inspector {

/// The colour of white light over the path difference x = d u (PHYSICS §4).
struct KernelStrip {
    double begin_nm = 0.0;
    double end_nm = 0.0;
    std::vector<glm::dvec3> xyz;  ///< of even cells: the kernel's mean over each, summed over R, G and B; per nm
};

/// Over what any pair of directions shows, |x| ≤ 2d, as far as the kernel is not 0. No cells where it is 0 everywhere.
KernelStrip kernel_strip(const diffraction::KernelTable& kernel, double pitch_nm, int cells = 512);

}  // namespace rowland::inspector
