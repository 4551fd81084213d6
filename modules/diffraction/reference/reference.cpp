#include "modules/diffraction/reference/reference.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "modules/diffraction/reference/arc_profile.h"
#include "modules/diffraction/reference/path_weights.h"

namespace rowland::diffraction {

namespace {

/// Several neighbouring wavelengths' arcs cross each texel. Their nodes are staggered by multiples of the golden ratio,
/// so that together they sample it that much more finely than each does.
double node_offset(std::size_t arc) {
    const double multiple = static_cast<double>(arc) * (std::numbers::phi - 1.0);
    return multiple - std::floor(multiple);
}

glm::dvec3 frame_radiance(const IncidentLight& light, const Grating& grating, const std::vector<PathWeight>& weights,
                          const Frame& frame) {
    const glm::dmat3 tangent = world_to_tangent(frame);
    const glm::dvec3 v = tangent * glm::normalize(frame.view);
    if (v.z <= 0.0) return glm::dvec3(0.0);
    glm::dvec3 xyz(0.0);
    // Order 0 has one arc for all wavelengths: it is integrated once.
    double last_arc = 2.0;
    glm::dvec3 profile(0.0);
    const bool lobe_is_fixed = is_flat(grating.lobe);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double a = weights[i].path_nm / grating.pitch_nm - v.x;
        if (a <= -1.0 || a >= 1.0) continue;
        if (a != last_arc || !lobe_is_fixed)
            profile = arc_profile(
                light, tangent, grating.lobe,
                {.a = a, .v_h = v.y, .wavelength_nm = weights[i].wavelength_nm, .node_offset = node_offset(i)});
        last_arc = a;
        xyz += weights[i].weight * profile;
    }
    return xyz;
}

std::vector<glm::dvec3> radiance(const Grating& grating, const IncidentLight& light,
                                 const colour::LightSpectra& spectra, std::span<const Frame> frames) {
    const std::vector<PathWeight> weights = path_weights(grating, spectra, light.panel_angle());
    std::vector<glm::dvec3> result(frames.size());
    Progress progress("reference", frames.size());
    parallel_for(frames.size(), [&](std::size_t i) {
        result[i] = frame_radiance(light, grating, weights, frames[i]);
        progress.advance();
    });
    return result;
}

}  // namespace

std::vector<glm::dvec3> reference_radiance(const Grating& grating, const lighting::ProbeImage& probe,
                                           const colour::LightSpectra& spectra, std::span<const Frame> frames) {
    return radiance(grating, ProbeLight(probe), spectra, frames);
}

std::vector<glm::dvec3> reference_radiance(const Grating& grating, const lighting::ShLight& light,
                                           const colour::LightSpectra& spectra, std::span<const Frame> frames) {
    return radiance(grating, BandlimitedLight(light), spectra, frames);
}

}  // namespace rowland::diffraction
