#include "modules/diffraction/model/grating.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/colour/illuminant.h"
#include "engine/colour/spectrum.h"
#include "engine/core/check.h"

namespace rowland::diffraction {

double transmittance(double ior, double cosine) {
    if (!(cosine > 0.0)) return 0.0;
    // `inside` is n times the cosine in the medium. The sum of 1 − r² over both polarisations is written so that
    // nothing cancels at grazing incidence.
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

namespace {

/// Finite, and long enough to have a direction.
bool has_direction(const glm::dvec3& v) {
    const double length = glm::length(v);
    return std::isfinite(length) && length > 1e-12;
}

}  // namespace

bool is_valid(const ShadingPoint& frame) {
    if (!has_direction(frame.view) || !has_direction(frame.normal) || !has_direction(frame.grating)) return false;
    return has_direction(glm::cross(glm::normalize(frame.normal), glm::normalize(frame.grating)));
}

glm::dmat3 world_to_tangent(const ShadingPoint& frame) {
    ROWLAND_CHECK(is_valid(frame), "a frame needs three directions, the grating vector not along the normal");
    const glm::dvec3 n = glm::normalize(frame.normal);
    const glm::dvec3 h = glm::normalize(glm::cross(n, glm::normalize(frame.grating)));
    const glm::dvec3 g = glm::cross(h, n);
    return glm::transpose(glm::dmat3(g, h, n));
}

ShadingPoint lit_from_behind(const ShadingPoint& frame) {
    const glm::dvec3 n = glm::normalize(frame.normal);
    return {.view = frame.view - 2.0 * glm::dot(frame.view, n) * n, .normal = -n, .grating = frame.grating};
}

namespace {

/// The wavelength for which 4π depth/λ is the phase of a groove's depth: λ in the medium that the grooves lie in or,
/// for light that passes a sheet, by PHYSICS (12.1), infinite at index 1. For a table, λ in air.
double groove_wavelength(const Grating& grating, double wavelength_nm) {
    if (std::holds_alternative<EfficiencyTable>(grating.profile)) return wavelength_nm;
    if (grating.transmission) return 2.0 * wavelength_nm / (grating.transmission->ior - 1.0);
    return wavelength_nm / groove_medium(grating.cover);
}

/// The ratio of the paper's peak form to the energy form, 2λ/(N d (b/d)²)·I₀, where I₀ makes it 1 at 550 nm.
double normalization_factor(const Grating& grating, double wavelength_nm) {
    if (grating.normalization == Normalization::Energy) return 1.0;
    ROWLAND_CHECK(std::holds_alternative<SlitProfile>(grating.profile), "the agu normalisation is for slits");
    return wavelength_nm / kAguWavelength_nm;
}

/// +1, or −1 for the reflected side of a sheet, whose order m is order −m of the profile: the sheet is thickest where
/// its relief is least deep.
int order_sign(const Grating& grating) {
    return grating.side_reflectance ? -1 : 1;
}

}  // namespace

double reflectance(const Grating& grating, double wavelength_nm) {
    if (std::holds_alternative<EfficiencyTable>(grating.profile)) return 1.0;
    if (grating.transmission) return 1.0 - grating.transmission->reflectance;
    if (grating.side_reflectance) return *grating.side_reflectance;
    const double metal =
        grating.metal ? colour::metal_reflectance(*grating.metal, wavelength_nm, groove_medium(grating.cover)) : 1.0;
    return metal * dye_transmittance(grating.cover, wavelength_nm);
}

double order_efficiency(const Grating& grating, int order, double wavelength_nm, double direction) {
    if (grating.efficiencies)
        return dye_transmittance(grating.cover, wavelength_nm) *
               grating.efficiencies->at(order, wavelength_nm, direction);
    return reflectance(grating, wavelength_nm) * normalization_factor(grating, wavelength_nm) *
           profile_efficiency(grating.profile, grating.pitch_nm, order_sign(grating) * order,
                              groove_wavelength(grating, wavelength_nm), direction);
}

double fractional_order_efficiency(const Grating& grating, double fractional_order, double wavelength_nm) {
    return reflectance(grating, wavelength_nm) * normalization_factor(grating, wavelength_nm) *
           groove_spectrum(grating.profile, grating.pitch_nm, order_sign(grating) * fractional_order,
                           groove_wavelength(grating, wavelength_nm));
}

std::vector<double> lattice_order_efficiencies(const Grating& grating, double wavelength_nm) {
    std::vector<double> orders = lattice_efficiencies(*grating.lattice, groove_wavelength(grating, wavelength_nm));
    const double reflected = reflectance(grating, wavelength_nm);
    for (double& efficiency : orders) efficiency *= reflected;
    if (order_sign(grating) < 0) std::reverse(orders.begin(), orders.end());
    return orders;
}

double zero_order_efficiency(const Grating& grating, double wavelength_nm) {
    if (grating.efficiencies) return order_efficiency(grating, 0, wavelength_nm);
    const double in_grooves_nm = groove_wavelength(grating, wavelength_nm);
    return reflectance(grating, wavelength_nm) *
           (grating.lattice ? lattice_zero_order(*grating.lattice, in_grooves_nm)
                            : profile_efficiency(grating.profile, grating.pitch_nm, 0, in_grooves_nm));
}

glm::dmat3 observed_spectra(const colour::LightSpectra& spectra, double wavelength_nm) {
    return glm::outerProduct(colour::cie_xyz(wavelength_nm), spectra(wavelength_nm));
}

}  // namespace rowland::diffraction
