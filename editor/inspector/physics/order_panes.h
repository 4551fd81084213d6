#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/model/grating.h"

// What the panes plot of a grating's orders. "Shown orders" are the listed ones and the mirror's order 0.

namespace rowland::inspector {

/// One order of one wavelength in the plane across the grooves.
struct OrderPeak {
    int order = 0;
    double angle_deg = 0.0;  ///< of the diffracted light; positive toward +g
    double efficiency = 0.0;
    double brdf = 0.0;  ///< at the peak, 1/sr; 0 if the order is not listed
};

/// The diffraction term over the angle of view, for light of one wavelength.
struct AngleCurve {
    std::vector<glm::dvec2> points;  ///< (angle in degrees, BRDF in 1/sr), ascending
    std::vector<OrderPeak> peaks;    ///< the shown orders that leave the surface, ascending angles
};

/// brdf_energy() (PHYSICS §3) for light from `incidence_deg`, of a sheet from behind, and views in the plane across the
/// grooves, both within ±90°: at about `samples` even angles, with more around each peak.
AngleCurve angle_curve(const diffraction::Grating& grating, double wavelength_nm, double incidence_deg,
                       int samples = 721);

/// The fraction of the power that one order gets.
struct EfficiencyCurve {
    int order = 0;
    std::vector<glm::dvec2> points;  ///< (wavelength in nm, efficiency), 380 to 780 nm
};

/// The shown orders' efficiencies at normal incidence, ascending; of many orders the `most` strongest. Under a cover:
/// of what enters it.
std::vector<EfficiencyCurve> efficiency_curves(const diffraction::Grating& grating, std::size_t most = 9);

/// Where the power of one wavelength goes, as fractions that sum to 1. Under a cover: of what enters it.
struct EnergyBalance {
    double orders = 0.0;      ///< listed orders that leave the surface
    double zero = 0.0;        ///< the mirror's order
    double evanescent = 0.0;  ///< listed orders that do not leave the surface: lost to the scalar model
    double absorbed = 0.0;    ///< by the metal and a cover's dye; for a table, what its orders leave of 1
    double rest = 0.0;        ///< orders that are not listed, and losses of the profile: lights the base
};

/// For light of a wavelength from s_g, |s_g| ≤ 1, energy-normalised whatever the material's normalisation is.
EnergyBalance energy_balance(diffraction::Grating grating, double wavelength_nm, double s_g);

/// The direction of one wavelength of an order: components of the unit vector across and along the grooves.
struct OrderSpot {
    double wavelength_nm = 0.0;
    double v_g = 0.0;
    double v_h = 0.0;
};

struct OrderTrace {
    int order = 0;
    std::vector<OrderSpot> spots;  ///< that leave the surface, ascending wavelengths
};

/// Where the shown orders send light from the direction `s` of the tangent frame (g, h, n), s_n > 0:
/// d (s_g + v_g) = mλ, s_h + v_h = 0 (PHYSICS §2), every 5 nm from 380 to 780 nm. Orders without spots are left out.
std::vector<OrderTrace> order_directions(const diffraction::Grating& grating, const glm::dvec3& s);

/// The colour of white light over the path difference x = d u (PHYSICS §4).
struct KernelStrip {
    double begin_nm = 0.0;
    double end_nm = 0.0;
    std::vector<glm::dvec3> xyz;  ///< of even cells: the kernel's mean over each, summed over R, G and B; per nm
};

/// Over all path differences that directions can have, |x| ≤ 2d, where the kernel is not 0. No cells if it is 0
/// everywhere.
KernelStrip kernel_strip(const diffraction::KernelTable& kernel, double pitch_nm, int cells = 512);

}  // namespace rowland::inspector
