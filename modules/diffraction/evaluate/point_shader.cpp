#include "modules/diffraction/evaluate/point_shader.h"

#include <glm/geometric.hpp>
#include <memory>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/lighting/prefilter.h"
#include "engine/math/sh_rotation.h"
#include "modules/diffraction/bake/cube_pyramid.h"
#include "modules/diffraction/bake/direct.h"
#include "modules/diffraction/bake/streak.h"

namespace rowland::diffraction {

namespace {

constexpr int kMostFilterTaps = 8;  ///< along the longer side of a streak's footprint

/// Shades a tangent-frame view under light in the same frame.
using TangentShader = std::function<glm::dvec3(const lighting::ShLight&, const glm::dvec3& view)>;

/// Turns the light into every frame and shades there.
PointShader in_tangent_frame(lighting::ShLight light, TangentShader shade) {
    return [light = std::move(light), shade = std::move(shade)](const Frame& frame) {
        const glm::dmat3 tangent = world_to_tangent(frame);
        const glm::dvec3 view = tangent * glm::normalize(frame.view);
        if (view.z <= 0.0) return glm::dvec3(0.0);
        lighting::ShLight rotated{light.bands, std::vector<glm::dvec3>(light.coefficients.size())};
        math::ShRotation(tangent, light.bands)
            .apply(std::span<const glm::dvec3>(light.coefficients), std::span<glm::dvec3>(rotated.coefficients));
        return shade(rotated, view);
    };
}

/// Shades with any of the tables over SH light.
template <typename Table>
PointShader by_table(Table table, const EvaluationLight& light) {
    lighting::ShLight harmonics = light.harmonics(table.bands);
    return in_tangent_frame(std::move(harmonics),
                            [table = std::move(table)](const lighting::ShLight& rotated, const glm::dvec3& view) {
                                return evaluate(table, rotated, view);
                            });
}

PointShader shader_of(const SpikeTable& table, const CookedMaterial&, const EvaluationLight& light) {
    return in_tangent_frame(light.harmonics(table.bands),
                            [table](const lighting::ShLight& rotated, const glm::dvec3& view) {
                                return evaluate_spikes(sample(table, view.x, view.y, view.z), rotated);
                            });
}
PointShader shader_of(const BinTable& table, const CookedMaterial&, const EvaluationLight& light) {
    return by_table(table, light);
}
PointShader shader_of(const TransferTable& table, const CookedMaterial&, const EvaluationLight& light) {
    return by_table(table, light);
}
PointShader shader_of(const ArcTable& table, const CookedMaterial&, const EvaluationLight& light) {
    return in_tangent_frame(
        light.harmonics(table.bands),
        [table](const lighting::ShLight& rotated, const glm::dvec3& view) { return evaluate(table, rotated, view); });
}
PointShader shader_of(const DirectTables&, const CookedMaterial&, const EvaluationLight&) {
    return [](const Frame&) { return glm::dvec3(0.0); };
}
PointShader shader_of(const PlanarTables& tables, const CookedMaterial& cooked, const EvaluationLight& light) {
    // Frames come in any order, but those of one plane one after the other; only the last plane's map is kept.
    struct Plane {
        glm::dvec3 normal{0.0};
        PlanarMap map;
    };
    return
        [&cooked, size = tables.size, texels = light.texels(), last = std::make_shared<Plane>()](const Frame& frame) {
            const glm::dvec3 normal = glm::normalize(frame.normal);
            if (normal != last->normal)
                *last = {normal, fill_planar_map(texels, cooked.kernel, cooked.material.grating.pitch_nm, normal, size,
                                                 cooked.zero_order_xyz)};
            return sample(last->map, frame);
        };
}
PointShader shader_of(const CircleTables& tables, const CookedMaterial& cooked, const EvaluationLight& light) {
    return [map = fill_circle_map(light.texels(), cooked.kernel, cooked.material.grating.pitch_nm, tables.size,
                                  cooked.zero_order_xyz)](const Frame& frame) { return sample(map, frame); };
}

/// What is thrown where a streak is asked for without a probe.
Error needs_a_probe() {
    return Error({.file = "--probe-sh",
                  .place = {},
                  .found = "band-limited light",
                  .expected = "a probe for streaks",
                  .remedy = "give --probe"});
}

PointShader shader_of(const StreakTables& tables, const CookedMaterial&, const EvaluationLight& light) {
    if (!light.probe()) throw needs_a_probe();
    PointShader rest = [](const Frame&) { return glm::dvec3(0.0); };
    if (tables.rest)
        rest = in_tangent_frame(light.harmonics(tables.rest->bands),
                                [table = *tables.rest](const lighting::ShLight& rotated, const glm::dvec3& view) {
                                    return evaluate(table, rotated, view);
                                });
    return [pyramid = std::make_shared<const CubePyramid>(lighting::prefilter(*light.probe())), &tables,
            rest](const Frame& frame) {
        const glm::dmat3 tangent = world_to_tangent(frame);
        const glm::dmat3 to_world = glm::transpose(tangent);
        const auto radiance = [&](const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b) {
            return pyramid->filtered(to_world * direction, to_world * a, to_world * b, kStreakFilterTaps);
        };
        const glm::dvec3 view = tangent * glm::normalize(frame.view);
        return evaluate(tables.streak, radiance, view, tables.taps) + (1.0 - tables.streak.share) * rest(frame);
    };
}

/// Key lights, and what shades them one by one.
struct DirectPart {
    DirectMaterial material;
    std::vector<lighting::KeyLight> keys;
};

/// Streaks show the whole probe: key lights are for the rest of the lobe alone.
DirectPart direct_part(const CookedMaterial& cooked, const EvaluationLight& light) {
    const Grating& grating = cooked.material.grating;
    DirectPart part{
        .material = {.pitch_nm = grating.pitch_nm, .zero_order_xyz = cooked.zero_order_xyz, .lobe = grating.lobe},
        .keys = {light.key_lights().begin(), light.key_lights().end()}};
    const auto* tables = std::get_if<StreakTables>(&cooked.tables);
    if (tables == nullptr) return part;
    if (!tables->rest) part.keys.clear();
    if (const auto rest = incoherent_rest(grating)) part.material.lobe = rest->lobe;
    for (lighting::KeyLight& key : part.keys) key.flux *= 1.0 - tables->streak.share;
    return part;
}

}  // namespace

std::vector<glm::dvec3> evaluate_points(const std::string& title, const PointShader& shader,
                                        const CookedMaterial& cooked, const EvaluationLight& light,
                                        std::span<const Frame> frames) {
    const DirectPart direct = direct_part(cooked, light);
    std::vector<glm::dvec3> result(frames.size());
    Progress progress(title, frames.size());
    parallel_for(frames.size(), [&](std::size_t i) {
        result[i] = shader(frames[i]) + direct_radiance(cooked.kernel, direct.material, direct.keys, frames[i]);
        progress.advance();
    });
    return result;
}

PointShader baked_shader(const CookedMaterial& cooked, const EvaluationLight& light) {
    return std::visit([&](const auto& tables) { return shader_of(tables, cooked, light); }, cooked.tables);
}

std::vector<glm::dvec3> evaluate_baked(const CookedMaterial& cooked, const EvaluationLight& light,
                                       std::span<const Frame> frames) {
    const PointShader shader = baked_shader(cooked, light);
    const std::string title = representation_name(cooked.tables.index());
    if (!std::holds_alternative<PlanarTables>(cooked.tables))
        return evaluate_points(title, shader, cooked, light, frames);
    // A plane's map is filled by all cores, so that the frames come one after the other.
    std::vector<glm::dvec3> maps(frames.size());
    Progress progress(title, frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        maps[i] = shader(frames[i]);
        progress.advance();
    }
    const DirectPart direct = direct_part(cooked, light);
    for (std::size_t i = 0; i < frames.size(); ++i)
        maps[i] += direct_radiance(cooked.kernel, direct.material, direct.keys, frames[i]);
    return maps;
}

PointShader exact_spikes(const Grating& grating, const SpikeSettings& settings, const EvaluationLight& light) {
    return in_tangent_frame(light.harmonics(settings.bands),
                            [baker = std::make_shared<const SpikeBaker>(grating, settings)](
                                const lighting::ShLight& rotated, const glm::dvec3& view) {
                                return evaluate_spikes(baker->bake(view.x, view.y), rotated);
                            });
}

PointShader streak(const Grating& grating, const colour::LightSpectra& spectra, int bands,
                   const EvaluationLight& light) {
    if (!light.probe()) throw needs_a_probe();
    const auto pyramid = std::make_shared<const CubePyramid>(lighting::prefilter(*light.probe()));
    const Streak narrow = make_streak(grating, {.illuminant = spectra.illuminant()});
    PointShader rest = [](const Frame&) { return glm::dvec3(0.0); };
    if (const auto smooth = incoherent_rest(grating)) {
        const TransferSettings settings{
            .bands = bands, .grid = {}, .storage = Storage::Float, .illuminant = spectra.illuminant()};
        rest = by_table(bake_transfer_table(*smooth, settings), light);
    }
    return [pyramid, narrow, rest](const Frame& frame) {
        const glm::dmat3 tangent = world_to_tangent(frame);
        const glm::dmat3 to_world = glm::transpose(tangent);
        const auto radiance = [&](const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b) {
            return pyramid->filtered(to_world * direction, to_world * a, to_world * b, kMostFilterTaps);
        };
        const glm::dvec3 view = tangent * glm::normalize(frame.view);
        return evaluate(narrow, radiance, view) + (1.0 - narrow.share) * rest(frame);
    };
}

}  // namespace rowland::diffraction
