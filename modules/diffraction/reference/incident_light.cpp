#include "modules/diffraction/reference/incident_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/math/quadrature.h"
#include "engine/math/spherical_harmonics.h"

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

namespace {

/// Fewest nodes of an arc: the midpoint rule's error is then below 1e-4 of the arc.
constexpr int kMinimumNodes = 64;

/// The part of the half circle that the lobe reaches.
struct ArcSpan {
    double begin = 0.0;
    double end = pi;
};

ArcSpan lobe_span(const GrooveLobe& lobe, double v_h, double r) {
    const double half_width = lobe_extent(lobe).half_width;
    // s_h = r cos t falls with t.
    return {std::acos(std::clamp((-v_h + half_width) / r, -1.0, 1.0)),
            std::acos(std::clamp((-v_h - half_width) / r, -1.0, 1.0))};
}

/// Panels no longer than the light asks for, nor than the lobe's feature size (a sixth of it if a panel has one node).
int panel_count(const IncidentLight& light, const GrooveLobe& lobe, double r, double length) {
    const double lobe_panel = lobe_extent(lobe).feature_size * (light.nodes_per_panel > 1 ? 1.0 : 1.0 / 6.0);
    const double panel = std::min(light.panel_angle, lobe_panel);
    const int minimum = (kMinimumNodes + light.nodes_per_panel - 1) / light.nodes_per_panel;
    return std::max(static_cast<int>(std::ceil(length * r / panel)), minimum);
}

const math::QuadratureRule& panel_rule(int nodes) {
    static thread_local math::QuadratureRule rule;
    if (rule.nodes.size() != static_cast<std::size_t>(nodes)) rule = math::gauss_legendre(nodes, 0.0, 1.0);
    return rule;
}

}  // namespace

glm::dmat3 mirrored_in_surface(const glm::dmat3& world_to_tangent) {
    return glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1)) * world_to_tangent;
}

glm::dvec3 arc_profile(const IncidentLight& light, const glm::dmat3& world_to_tangent, const GrooveLobe& lobe,
                       const Arc& arc, const std::optional<Cover>& cover) {
    if (std::abs(arc.a) >= 1.0) return glm::dvec3(0.0);
    const double r = std::sqrt((1.0 - arc.a) * (1.0 + arc.a));
    const ArcSpan span = lobe_span(lobe, arc.v_h, r);
    const double length = span.end - span.begin;
    if (length <= 0.0) return glm::dvec3(0.0);

    const glm::dmat3 axes = glm::transpose(world_to_tangent);
    const int panels = arc.refinement * panel_count(light, lobe, r, length);
    const double panel_length = length / panels;
    const math::QuadratureRule& rule = panel_rule(light.nodes_per_panel);
    const double shift = light.nodes_per_panel == 1 ? arc.node_offset - 0.5 : 0.0;
    const LobeDensity density(lobe, arc.wavelength_nm);
    glm::dvec3 sum(0.0);
    for (int panel = 0; panel < panels; ++panel) {
        for (std::size_t node = 0; node < rule.nodes.size(); ++node) {
            const double t = span.begin + (panel + rule.nodes[node] + shift) * panel_length;
            const double s_h = r * std::cos(t);
            const double s_n = r * std::sin(t);
            const double spread = 2.0 * density(s_h + arc.v_h) * transmittance(cover, s_n);
            const glm::dvec3 direction = arc.a * axes[0] + s_h * axes[1] + s_n * axes[2];
            sum += (rule.weights[node] * s_n * spread) * light.radiance(direction);
        }
    }
    return 0.5 * panel_length * sum;
}

}  // namespace rowland::diffraction
