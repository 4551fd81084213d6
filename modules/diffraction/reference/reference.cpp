#include "modules/diffraction/reference/reference.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/reference/incident_light.h"

namespace rowland::diffraction {

namespace {

/// One term of the sum over wavelengths and orders: the light on the arc s_g = path_nm/pitch − v_g adds weight · A to
/// XYZ (PHYSICS §4).
struct PathWeight {
    double path_nm = 0.0;        ///< x = mλ
    double wavelength_nm = 0.0;  ///< λ, for the lobe
    glm::dmat3 weight{0.0};  ///< ∫ η_m cmf Eᵀ dλ of this node, RGB in, XYZ out; without η_m if that depends on s_g
    int order = 0;           ///< m, for an η_m that depends on s_g
};

/// cmf Eᵀ dλ at one node of the trapezoid rule over the visible range.
struct ObservedNode {
    double wavelength_nm = 0.0;
    glm::dmat3 observed{0.0};
};

std::vector<ObservedNode> observed_nodes(const colour::LightSpectra& spectra, int nodes_per_nm) {
    const int last = (colour::kVisibleMax - colour::kVisibleMin) * nodes_per_nm;
    std::vector<ObservedNode> nodes;
    for (int i = 0; i <= last; ++i) {
        const double wavelength_nm = colour::kVisibleMin + static_cast<double>(i) / nodes_per_nm;
        const double step_nm = (i == 0 || i == last ? 0.5 : 1.0) / nodes_per_nm;
        nodes.push_back({wavelength_nm, step_nm * observed_spectra(spectra, wavelength_nm)});
    }
    return nodes;
}

/// Sharp orders: the light of order m and wavelength λ lies on one arc.
std::vector<PathWeight> sharp_orders(const Grating& grating, const colour::LightSpectra& spectra, double largest_step,
                                     int refinement) {
    std::vector<PathWeight> weights;
    const bool at_each_arc = depends_on_incidence(grating.profile);
    for (const int order : grating.orders) {
        const double step_at_1nm = std::abs(order) / grating.pitch_nm;
        const int nodes_per_nm = refinement * std::max(1, static_cast<int>(std::ceil(step_at_1nm / largest_step)));
        for (const auto& [wavelength_nm, observed] : observed_nodes(spectra, nodes_per_nm)) {
            const double efficiency = at_each_arc ? 1.0 : order_efficiency(grating, order, wavelength_nm);
            weights.push_back({order * wavelength_nm, wavelength_nm, efficiency * observed, order});
        }
    }
    return weights;
}

/// The weight at one path difference of few grooves: every wavelength contributes, by its Fejér ratio.
glm::dmat3 blurred_weight(const Grating& grating, const std::vector<ObservedNode>& spectrum, double path_nm) {
    glm::dmat3 sum(0.0);
    for (const ObservedNode& node : spectrum) {
        const double fractional_order = path_nm / node.wavelength_nm;
        const double nearest = std::round(fractional_order);
        const int order = static_cast<int>(nearest);
        if (!lists(grating, order) || !propagates(order, node.wavelength_nm, grating.pitch_nm)) continue;
        const double density = grating.grooves / node.wavelength_nm *
                               fejer(grating.grooves, fractional_order - nearest) *
                               fractional_order_efficiency(grating, fractional_order, node.wavelength_nm);
        sum += density * node.observed;
    }
    return sum;
}

/// Wide orders. The lobe is evaluated at the middle of the range: those allowed with few grooves do not depend on
/// wavelength.
std::vector<PathWeight> wide_orders(const Grating& grating, const colour::LightSpectra& spectra, double largest_step,
                                    int refinement) {
    const std::vector<ObservedNode> spectrum = observed_nodes(spectra, refinement);
    ROWLAND_CHECK(!std::holds_alternative<PitsLobe>(grating.lobe), "pits with few grooves");
    // An order is λ/N ≥ 7.7 nm wide in x.
    const double step_nm = std::min(1.0, largest_step * grating.pitch_nm) / refinement;
    const double largest_path_nm = 2.0 * grating.pitch_nm;
    const auto half_count = static_cast<std::size_t>(std::ceil(largest_path_nm / step_nm));
    std::vector<PathWeight> weights(2 * half_count + 1);
    parallel_for(weights.size(), [&](std::size_t i) {
        const double path_nm = step_nm * (static_cast<double>(i) - static_cast<double>(half_count));
        weights[i] = {path_nm, 0.5 * (colour::kVisibleMin + colour::kVisibleMax),
                      step_nm * blurred_weight(grating, spectrum, path_nm)};
    });
    return weights;
}

/// All terms of a grating under light of the given spectra. Orders are summed by the trapezoid rule at 1 nm, or at
/// smaller steps if 1 nm moves an arc by more than `largest_step` in s_g. For fewer than kManyGrooves grooves the nodes
/// are equidistant in x, and each wavelength is spread by its Fejér ratio, (N/λ) F_N(x/λ), over the listed orders.
/// `refinement` ≥ 1 divides every step, in λ and in x.
std::vector<PathWeight> path_weights(const Grating& grating, const colour::LightSpectra& spectra, double largest_step,
                                     int refinement) {
    ROWLAND_CHECK_OP(grating.pitch_nm, >, 0.0);
    ROWLAND_CHECK_OP(grating.grooves, >=, 1.0);
    ROWLAND_CHECK_OP(largest_step, >, 0.0);
    ROWLAND_CHECK_OP(refinement, >=, 1);
    auto weights = grating.grooves >= kManyGrooves ? sharp_orders(grating, spectra, largest_step, refinement)
                                                   : wide_orders(grating, spectra, largest_step, refinement);
    std::erase_if(weights, [](const PathWeight& term) { return term.weight == glm::dmat3(0.0); });
    return weights;
}

/// The arcs of several neighbouring wavelengths cross each texel. Their nodes are staggered by multiples of the golden
/// ratio, so that together they sample the texel more finely than one arc does.
double node_offset(std::size_t arc) {
    const double multiple = static_cast<double>(arc) * (std::numbers::phi - 1.0);
    return multiple - std::floor(multiple);
}

/// A term's weight on the arc s_g = a.
glm::dmat3 weight_on_arc(const Grating& grating, const PathWeight& term, double a) {
    if (!depends_on_incidence(grating.profile)) return term.weight;
    return order_efficiency(grating, term.order, term.wavelength_nm, a) * term.weight;
}

glm::dvec3 frame_radiance(const IncidentLight& light, const Grating& grating, const std::vector<PathWeight>& weights,
                          const ShadingPoint& frame, int refinement) {
    const glm::dmat3 tangent = world_to_tangent(frame);
    const glm::dvec3 v = tangent * glm::normalize(frame.view);
    if (v.z <= 0.0) return glm::dvec3(0.0);
    const glm::dmat3 light_axes = grating.transmission ? mirrored_in_surface(tangent) : tangent;
    glm::dvec3 xyz(0.0);
    // All wavelengths of order 0 have the same arc: it is integrated once.
    double last_arc = 2.0;
    glm::dvec3 profile(0.0);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double a = weights[i].path_nm / grating.pitch_nm - v.x;
        if (a <= -1.0 || a >= 1.0) continue;
        if (a != last_arc || !is_flat(grating.lobe))
            profile = arc_profile(light, light_axes, grating.lobe,
                                  {.a = a,
                                   .v_h = v.y,
                                   .wavelength_nm = weights[i].wavelength_nm,
                                   .node_offset = node_offset(i),
                                   .refinement = refinement},
                                  grating.cover);
        last_arc = a;
        xyz += weight_on_arc(grating, weights[i], a) * profile;
    }
    return transmittance(grating.cover, v.z) * xyz;
}

std::vector<glm::dvec3> side_radiance(const Grating& grating, const IncidentLight& light,
                                      const colour::LightSpectra& spectra, std::span<const ShadingPoint> frames,
                                      int refinement) {
    if (grating.lattice) return lattice_radiance(grating, light, spectra, frames, refinement);
    const std::vector<PathWeight> weights = path_weights(grating, spectra, light.panel_angle, refinement);
    std::vector<glm::dvec3> result(frames.size());
    Progress progress(refinement == 1 ? "reference" : "reference, finer", frames.size());
    parallel_for(frames.size(), [&](std::size_t i) {
        result[i] = frame_radiance(light, grating, weights, frames[i], refinement);
        progress.advance();
    });
    return result;
}

/// Of both sides of a sheet.
std::vector<glm::dvec3> radiance(const Grating& grating, const IncidentLight& light,
                                 const colour::LightSpectra& spectra, std::span<const ShadingPoint> frames,
                                 int refinement) {
    std::vector<glm::dvec3> result = side_radiance(grating, light, spectra, frames, refinement);
    if (const auto side = reflected_side(grating)) {
        const std::vector<glm::dvec3> reflected = side_radiance(*side, light, spectra, frames, refinement);
        for (std::size_t i = 0; i < result.size(); ++i) result[i] += reflected[i];
    }
    return result;
}

}  // namespace

std::vector<glm::dvec3> reference_radiance(const Grating& grating, const IncidentLight& light,
                                           const colour::LightSpectra& spectra, std::span<const ShadingPoint> frames) {
    return radiance(grating, light, spectra, frames, 1);
}

std::vector<CheckedRadiance> checked_reference(const Grating& grating, const IncidentLight& light,
                                               const colour::LightSpectra& spectra,
                                               std::span<const ShadingPoint> frames) {
    const std::vector<glm::dvec3> coarse = radiance(grating, light, spectra, frames, 1);
    const std::vector<glm::dvec3> fine = radiance(grating, light, spectra, frames, 2);
    std::vector<CheckedRadiance> result;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const double difference = glm::length(coarse[i] - fine[i]);
        result.push_back({coarse[i], difference == 0.0 ? 0.0 : difference / glm::length(fine[i])});
    }
    return result;
}

}  // namespace rowland::diffraction
