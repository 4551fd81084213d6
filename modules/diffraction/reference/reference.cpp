#include "modules/diffraction/reference/reference.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "modules/diffraction/model/efficiency.h"
#include "modules/diffraction/reference/arc_profile.h"
#include "modules/diffraction/reference/lattice_radiance.h"
#include "modules/diffraction/reference/path_weights.h"

namespace rowland::diffraction {

namespace {

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
