#include "editor/trade/spikes_method.h"

#include <glm/geometric.hpp>

#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/math/sh_rotation.h"

namespace rowland::trade {

namespace {

/// Rotates the light into every frame and sums it up with the spikes that spikes_of gives for the tangent-frame view.
template <typename SpikesOf>
std::vector<glm::dvec3> evaluate(const lighting::ShLight& light, const colour::LightSpectra& spectra,
                                 std::span<const diffraction::Frame> frames, const SpikesOf& spikes_of) {
    std::vector<glm::dvec3> result(frames.size(), glm::dvec3(0.0));
    Progress progress("spikes", frames.size());
    parallel_for(frames.size(), [&](std::size_t i) {
        const glm::dmat3 tangent = world_to_tangent(frames[i]);
        const glm::dvec3 v = tangent * glm::normalize(frames[i].view);
        if (v.z > 0.0) {
            lighting::ShLight rotated{light.bands, std::vector<glm::dvec3>(light.coefficients.size())};
            math::ShRotation(tangent, light.bands)
                .apply(std::span<const glm::dvec3>(light.coefficients), std::span<glm::dvec3>(rotated.coefficients));
            result[i] = evaluate_spikes(spikes_of(v), rotated, spectra);
        }
        progress.advance();
    });
    return result;
}

}  // namespace

std::vector<glm::dvec3> evaluate_exact_spikes(const diffraction::Grating& grating,
                                              const diffraction::SpikeSettings& settings,
                                              const lighting::ShLight& light, const colour::LightSpectra& spectra,
                                              std::span<const diffraction::Frame> frames) {
    const diffraction::SpikeBaker baker(grating, settings);
    return evaluate(light, spectra, frames, [&](const glm::dvec3& v) { return baker.bake(v.x, v.y); });
}

std::vector<glm::dvec3> evaluate_spike_table(const diffraction::SpikeTable& table, const lighting::ShLight& light,
                                             const colour::LightSpectra& spectra,
                                             std::span<const diffraction::Frame> frames) {
    return evaluate(light, spectra, frames, [&](const glm::dvec3& v) { return sample(table, v.x, v.y, v.z); });
}

}  // namespace rowland::trade
