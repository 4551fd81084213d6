#include "modules/diffraction/model/cover.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/colour/light_spectra.h"

namespace rowland::diffraction {

double transmittance(double ior, double cosine) {
    if (!(cosine > 0.0)) return 0.0;
    // n times the cosine inside. 1 − r² for the two polarisations; nothing cancels at grazing incidence.
    const double square = ior * ior;
    const double inside = std::sqrt(square - 1.0 + cosine * cosine);
    const double across = cosine + inside;
    const double along = square * cosine + inside;
    return 2.0 * cosine * inside * (1.0 / (across * across) + square / (along * along));
}

double dye_transmittance(const std::optional<Cover>& cover, double wavelength_nm) {
    if (!cover || cover->tint == glm::dvec3(1.0)) return 1.0;
    const double once = glm::dot(cover->tint, colour::rgb_basis(wavelength_nm));
    return once * once;
}

}  // namespace rowland::diffraction
