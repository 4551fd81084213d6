#include "modules/diffraction/evaluate/point_shader.h"

#include <glm/geometric.hpp>
#include <memory>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/math/sh_rotation.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "modules/diffraction/representations/streak/streak.h"

namespace rowland::diffraction {

namespace {

/// Key lights and the material of their direct term.
struct DirectPart {
    DirectMaterial material;
    std::vector<lighting::KeyLight> keys;
};

/// Streaks show the whole probe: key lights light only the incoherent rest of the lobe.
DirectPart direct_part(const CookedMaterial& cooked, const EvaluationLight& light) {
    const Grating& grating = cooked.material.grating;
    DirectPart part{.material = {.pitch_nm = grating.pitch_nm,
                                 .zero_order_xyz = cooked.zero_order_xyz,
                                 .lobe = grating.lobe,
                                 .cover = grating.cover},
                    .keys = {light.key_lights().begin(), light.key_lights().end()}};
    const auto* tables = std::get_if<StreakTables>(&cooked.tables);
    if (tables == nullptr) return part;
    if (!tables->rest) part.keys.clear();
    if (const auto rest = incoherent_rest(grating)) part.material.lobe = rest->lobe;
    for (lighting::KeyLight& key : part.keys) key.flux *= 1.0 - tables->streak.power;
    return part;
}

/// T(v_n) of a point.
double seen_through(const std::optional<Cover>& cover, const ShadingPoint& frame) {
    return cover ? transmittance(cover, glm::dot(glm::normalize(frame.view), glm::normalize(frame.normal))) : 1.0;
}

}  // namespace

std::vector<glm::dvec3> evaluate_points(const std::string& title, const PointShader& shader,
                                        const CookedMaterial& cooked, const EvaluationLight& light,
                                        std::span<const ShadingPoint> frames) {
    const DirectPart direct = direct_part(cooked, light);
    std::vector<glm::dvec3> result(frames.size());
    Progress progress(title, frames.size());
    parallel_for(frames.size(), [&](std::size_t i) {
        result[i] = shader(frames[i]) + direct_radiance(cooked.kernel, direct.material, direct.keys, frames[i]);
        result[i] *= seen_through(direct.material.cover, frames[i]);
        progress.advance();
    });
    return result;
}

PointShader baked_shader(const CookedMaterial& cooked, const EvaluationLight& light) {
    const MaterialKernel kernel{.kernel = cooked.kernel,
                                .pitch_nm = cooked.material.grating.pitch_nm,
                                .zero_order_xyz = cooked.zero_order_xyz,
                                .cover = cooked.material.grating.cover};
    return std::visit([&](const auto& tables) { return point_shader(tables, kernel, light); }, cooked.tables);
}

std::vector<glm::dvec3> evaluate_baked(const CookedMaterial& cooked, const EvaluationLight& light,
                                       std::span<const ShadingPoint> frames) {
    const PointShader shader = baked_shader(cooked, light);
    const std::string title = info(cooked.tables).name;
    if (!info(cooked.tables).needs_flat_surface) return evaluate_points(title, shader, cooked, light, frames);
    // All cores fill a plane's map, so the points are shaded one after the other.
    std::vector<glm::dvec3> maps(frames.size());
    Progress progress(title, frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        maps[i] = shader(frames[i]);
        progress.advance();
    }
    const DirectPart direct = direct_part(cooked, light);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        maps[i] += direct_radiance(cooked.kernel, direct.material, direct.keys, frames[i]);
        maps[i] *= seen_through(direct.material.cover, frames[i]);
    }
    return maps;
}

PointShader exact_spikes(const Grating& grating, const SpikeSettings& settings, const EvaluationLight& light) {
    return in_tangent_frame(light.harmonics(settings.bands),
                            [baker = std::make_shared<const SpikeBaker>(grating, settings)](
                                const lighting::ShLight& rotated, const glm::dvec3& view) {
                                return evaluate_spikes(baker->bake(view.x, view.y), rotated);
                            });
}

}  // namespace rowland::diffraction
