#include "modules/diffraction/reference/incident_light.h"

#include <array>
#include <numbers>

#include "engine/core/check.h"
#include "engine/math/sh_basis.h"

namespace rowland::diffraction {

namespace {

using std::numbers::pi;

/// Quadrature panels per texel along an arc. With 4 instead, the named frame sets change by 3e-5 to 5e-5 (Grace, Ennis)
/// and, where lamps are one texel wide (Royal Esplanade), by 0.7 %.
constexpr double kPanelsPerTexel = 2.0;

/// The angle that a texel spans where texels are largest: on the equator, and at the centre of an angular map.
double texel_angle(const lighting::ProbeImage& probe) {
    if (probe.mapping() == lighting::Mapping::Angular) return 2.0 * pi / probe.image().width;
    return pi / probe.image().height;
}

glm::dvec3 sh_radiance(const lighting::ShLight& light, const glm::dvec3& direction) {
    std::array<double, math::sh_count(math::kMaximumBands)> basis;
    math::evaluate_sh(direction, light.bands, basis);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < light.coefficients.size(); ++i) sum += basis[i] * light.coefficients[i];
    return sum;
}

}  // namespace

IncidentLight::IncidentLight(const lighting::ProbeImage& probe)
    : radiance([&probe](const glm::dvec3& direction) { return probe.radiance(direction); }),
      panel_angle(texel_angle(probe) / kPanelsPerTexel) {}

IncidentLight::IncidentLight(const lighting::ShLight& light)
    : radiance([&light](const glm::dvec3& direction) { return sh_radiance(light, direction); }),
      panel_angle(pi / light.bands),
      nodes_per_panel(12) {
    ROWLAND_CHECK_OP(light.bands, >=, 1);
    ROWLAND_CHECK_OP(light.bands, <=, math::kMaximumBands);
    ROWLAND_CHECK_OP(light.coefficients.size(), ==, static_cast<std::size_t>(math::sh_count(light.bands)));
}

}  // namespace rowland::diffraction
