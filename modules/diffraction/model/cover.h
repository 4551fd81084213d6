#pragma once

#include <glm/vec3.hpp>
#include <optional>

namespace rowland::diffraction {

/// A transparent layer over the grooves: a disc's polycarbonate, a foil's lacquer (PHYSICS §10).
struct Cover {
    double ior = 1.58;  ///< n at all wavelengths, at least 1
    glm::dvec3 tint{
        1.0};  ///< linear Rec.709 in [0, 1]: what a dye in the layer passes on the way in, and on the way out
};

/// T(c), PHYSICS (26): the fraction of unpolarised light that enters a medium of index `ior` from air at an angle of
/// this cosine, or leaves it; by Fresnel's formulas. 0 at grazing incidence and below. |cosine| ≤ 1.
double transmittance(double ior, double cosine);

/// The same of a cover; 1 without one.
inline double transmittance(const std::optional<Cover>& cover, double cosine) {
    return cover ? transmittance(cover->ior, cosine) : 1.0;
}

/// τ², PHYSICS (29): what the tint passes on the way in and out at normal incidence; 1 without a cover.
double dye_transmittance(const std::optional<Cover>& cover, double wavelength_nm);

/// The index of the medium that the grooves lie in.
inline double groove_medium(const std::optional<Cover>& cover) {
    return cover ? cover->ior : 1.0;
}

}  // namespace rowland::diffraction
