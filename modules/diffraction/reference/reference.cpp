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

/// One term of the sum over wavelengths and orders, PHYSICS (4.1): it adds weight · A(path_difference_nm/pitch − v_g).
struct SpectralTerm {
    double path_difference_nm = 0.0;  ///< x = mλ
    double wavelength_nm = 0.0;       ///< λ, for the lobe
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

bool depends_on_incidence(const Grating& grating) {
    return depends_on_direction(grating) || depends_on_incidence(grating.profile);
}

/// For kManyGrooves grooves or more: each order and wavelength lies on one arc.
std::vector<SpectralTerm> infinite_grooves_terms(const Grating& grating, const colour::LightSpectra& spectra,
                                                 double largest_step, int refinement) {
    std::vector<SpectralTerm> terms;
    const bool depends_on_s_g = depends_on_incidence(grating);
    for (const int order : grating.orders) {
        const double s_g_per_nm = std::abs(order) / grating.pitch_nm;
        const int nodes_per_nm = refinement * std::max(1, static_cast<int>(std::ceil(s_g_per_nm / largest_step)));
        for (const auto& [wavelength_nm, observed] : observed_nodes(spectra, nodes_per_nm)) {
            const double efficiency = depends_on_s_g ? 1.0 : order_efficiency(grating, order, wavelength_nm);
            terms.push_back({order * wavelength_nm, wavelength_nm, efficiency * observed, order});
        }
    }
    return terms;
}

/// Weight at one path difference for fewer grooves, PHYSICS (4.5): each wavelength contributes by its Fejér ratio.
glm::dmat3 finite_grooves_weight(const Grating& grating, const std::vector<ObservedNode>& spectrum,
                                 double path_difference_nm) {
    glm::dmat3 sum(0.0);
    for (const ObservedNode& node : spectrum) {
        const double fractional_order = path_difference_nm / node.wavelength_nm;
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

/// For fewer than kManyGrooves grooves: nodes equidistant in x. The lobes that are allowed then do not depend on
/// wavelength, so each is evaluated at the middle of the range.
std::vector<SpectralTerm> finite_grooves_terms(const Grating& grating, const colour::LightSpectra& spectra,
                                               double largest_step, int refinement) {
    const std::vector<ObservedNode> spectrum = observed_nodes(spectra, refinement);
    ROWLAND_CHECK(!depends_on_wavelength(grating.lobe), "pits with few grooves");
    // 1 nm resolves the orders, which are λ/N ≥ 7.7 nm wide in x.
    const double step_nm = std::min(1.0, largest_step * grating.pitch_nm) / refinement;
    const double largest_path_difference_nm = 2.0 * grating.pitch_nm;
    const auto half_count = static_cast<std::size_t>(std::ceil(largest_path_difference_nm / step_nm));
    std::vector<SpectralTerm> terms(2 * half_count + 1);
    parallel_for(terms.size(), [&](std::size_t i) {
        const double path_difference_nm = step_nm * (static_cast<double>(i) - static_cast<double>(half_count));
        terms[i] = {path_difference_nm, 0.5 * (colour::kVisibleMin + colour::kVisibleMax),
                    step_nm * finite_grooves_weight(grating, spectrum, path_difference_nm)};
    });
    return terms;
}

/// All terms of a grating under light of the given spectra. Wavelengths are summed by the trapezoid rule at 1 nm, or at
/// smaller steps if 1 nm moves an arc by more than `largest_step` in s_g. `refinement` ≥ 1 divides every step, in λ and
/// in x.
std::vector<SpectralTerm> spectral_terms(const Grating& grating, const colour::LightSpectra& spectra,
                                         double largest_step, int refinement) {
    ROWLAND_CHECK_OP(grating.pitch_nm, >, 0.0);
    ROWLAND_CHECK_OP(grating.grooves, >=, 1.0);
    ROWLAND_CHECK_OP(largest_step, >, 0.0);
    ROWLAND_CHECK_OP(refinement, >=, 1);
    ROWLAND_CHECK(is_solved(grating), "a grating of rigorous theory is solved first");
    auto terms = grating.grooves >= kManyGrooves ? infinite_grooves_terms(grating, spectra, largest_step, refinement)
                                                 : finite_grooves_terms(grating, spectra, largest_step, refinement);
    std::erase_if(terms, [](const SpectralTerm& term) { return term.weight == glm::dmat3(0.0); });
    return terms;
}

/// Offset of an arc's nodes, in steps. The arcs of neighbouring wavelengths cross the same texel; offsets by multiples
/// of the golden ratio make them sample it more finely together than one arc does.
double node_offset(std::size_t arc_index) {
    const double multiple = static_cast<double>(arc_index) * (std::numbers::phi - 1.0);
    return multiple - std::floor(multiple);
}

/// A term's weight for light from s_g = a.
glm::dmat3 weight_at(const Grating& grating, const SpectralTerm& term, double a) {
    if (!depends_on_incidence(grating)) return term.weight;
    // A table is looked up directly, not through its grid.
    return (std::holds_alternative<EfficiencyTable>(grating.profile)
                ? profile_efficiency(grating.profile, grating.pitch_nm, term.order, term.wavelength_nm, a)
                : order_efficiency(grating, term.order, term.wavelength_nm, a)) *
           term.weight;
}

glm::dvec3 point_radiance(const IncidentLight& light, const Grating& grating, const std::vector<SpectralTerm>& terms,
                          const ShadingPoint& point, int refinement) {
    const glm::dmat3 tangent = world_to_tangent(point);
    const glm::dvec3 v = tangent * glm::normalize(point.view);
    if (v.z <= 0.0) return glm::dvec3(0.0);
    const glm::dmat3 light_axes = grating.transmission ? mirrored_in_surface(tangent) : tangent;
    glm::dvec3 xyz(0.0);
    // All wavelengths of order 0 have the same arc: it is integrated once.
    double last_arc = 2.0;
    glm::dvec3 arc_light(0.0);
    for (std::size_t i = 0; i < terms.size(); ++i) {
        const double a = terms[i].path_difference_nm / grating.pitch_nm - v.x;
        if (a <= -1.0 || a >= 1.0) continue;
        if (a != last_arc || !is_flat(grating.lobe))
            arc_light = arc_profile(light, light_axes, grating.lobe,
                                    {.a = a,
                                     .v_h = v.y,
                                     .wavelength_nm = terms[i].wavelength_nm,
                                     .node_offset = node_offset(i),
                                     .refinement = refinement},
                                    grating.cover);
        last_arc = a;
        xyz += weight_at(grating, terms[i], a) * arc_light;
    }
    return transmittance(grating.cover, v.z) * xyz;
}

std::vector<glm::dvec3> side_radiance(const Grating& grating, const IncidentLight& light,
                                      const colour::LightSpectra& spectra, std::span<const ShadingPoint> points,
                                      int refinement) {
    if (grating.lattice) return lattice_radiance(grating, light, spectra, points, refinement);
    const std::vector<SpectralTerm> terms = spectral_terms(grating, spectra, light.panel_angle, refinement);
    std::vector<glm::dvec3> result(points.size());
    Progress progress(refinement == 1 ? "reference" : "reference, finer", points.size());
    parallel_for(points.size(), [&](std::size_t i) {
        result[i] = point_radiance(light, grating, terms, points[i], refinement);
        progress.advance();
    });
    return result;
}

/// Radiance at each point; of a sheet, that of both sides.
std::vector<glm::dvec3> radiance(const Grating& grating, const IncidentLight& light,
                                 const colour::LightSpectra& spectra, std::span<const ShadingPoint> points,
                                 int refinement) {
    std::vector<glm::dvec3> result = side_radiance(grating, light, spectra, points, refinement);
    if (const auto side = reflected_side(grating)) {
        const std::vector<glm::dvec3> reflected = side_radiance(*side, light, spectra, points, refinement);
        for (std::size_t i = 0; i < result.size(); ++i) result[i] += reflected[i];
    }
    return result;
}

}  // namespace

std::vector<glm::dvec3> reference_radiance(const Grating& grating, const IncidentLight& light,
                                           const colour::LightSpectra& spectra, std::span<const ShadingPoint> points) {
    return radiance(grating, light, spectra, points, 1);
}

std::vector<CheckedRadiance> checked_reference(const Grating& grating, const IncidentLight& light,
                                               const colour::LightSpectra& spectra,
                                               std::span<const ShadingPoint> points) {
    const std::vector<glm::dvec3> coarse = radiance(grating, light, spectra, points, 1);
    const std::vector<glm::dvec3> fine = radiance(grating, light, spectra, points, 2);
    std::vector<CheckedRadiance> result;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double difference = glm::length(coarse[i] - fine[i]);
        result.push_back({coarse[i], difference == 0.0 ? 0.0 : difference / glm::length(fine[i])});
    }
    return result;
}

}  // namespace rowland::diffraction
