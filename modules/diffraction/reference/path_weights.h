#pragma once

#include <glm/mat3x3.hpp>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// One term of the sum over wavelengths and orders: the light on the arc s_g = path_nm/pitch − v_g adds weight · A to
/// XYZ (PHYSICS §4).
struct PathWeight {
    double path_nm = 0.0;        ///< x = mλ
    double wavelength_nm = 0.0;  ///< λ, for the lobe
    glm::dmat3 weight{0.0};  ///< ∫ η_m cmf Eᵀ dλ of this node, RGB in, XYZ out; without η_m if that depends on s_g
    int order = 0;           ///< m, for an η_m that depends on s_g
};

/// All terms of a grating under light of the given spectra. Orders are summed by the trapezoid rule at 1 nm, or at
/// smaller steps if 1 nm moves an arc by more than `largest_step` in s_g. For fewer than kManyGrooves grooves the nodes
/// are equidistant in x, and each wavelength is spread by its Fejér ratio, (N/λ) F_N(x/λ), over the listed orders.
/// `refinement` ≥ 1 divides every step, in λ and in x.
std::vector<PathWeight> path_weights(const Grating& grating, const colour::LightSpectra& spectra, double largest_step,
                                     int refinement = 1);

}  // namespace rowland::diffraction
