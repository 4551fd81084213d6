#include "modules/diffraction/reference/incident_light.h"

#include <array>
#include <numbers>

#include "engine/core/check.h"
#include "engine/math/sh_basis.h"

namespace rowland::diffraction {

namespace {

using std::numbers::pi;

/// Panels per texel along an arc: the one knob of the probe's quadrature. With it, twice as many change the named frame
/// sets by 3e-5 to 5e-5 (Grace, Ennis) and, where lamps are a texel wide (Royal Esplanade), by 0.7 %.
constexpr double kPanelsPerTexel = 2.0;

/// The angle a texel spans where texels are largest: on the equator, and at the centre of an angular map.
double texel_angle(const lighting::ProbeImage& probe) {
    if (probe.mapping() == lighting::Mapping::Angular) return 2.0 * pi / probe.image().width;
    return pi / probe.image().height;
}

}  // namespace

ProbeLight::ProbeLight(const lighting::ProbeImage& probe)
    : probe_(probe), panel_angle_(texel_angle(probe) / kPanelsPerTexel) {}

BandlimitedLight::BandlimitedLight(const lighting::ShLight& light) : light_(light), panel_angle_(pi / light.bands) {
    ROWLAND_CHECK_OP(light.bands, >=, 1);
    ROWLAND_CHECK_OP(light.bands, <=, math::kMaximumBands);
    ROWLAND_CHECK_OP(light.coefficients.size(), ==, static_cast<std::size_t>(math::sh_count(light.bands)));
}

glm::dvec3 BandlimitedLight::radiance(const glm::dvec3& direction) const {
    std::array<double, math::sh_count(math::kMaximumBands)> basis;
    math::evaluate_sh(direction, light_.bands, basis);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < light_.coefficients.size(); ++i) sum += basis[i] * light_.coefficients[i];
    return sum;
}

}  // namespace rowland::diffraction
