#include "modules/diffraction/evaluate/point_shader.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "engine/colour/illuminant.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "modules/diffraction/representations/streak/streak.h"

namespace rowland::diffraction {

namespace {

/// Key lights and the material of their direct term.
struct DirectPart {
    DirectMaterial material;
    std::vector<lighting::KeyLight> keys;
};

/// Streaks show the whole probe: key lights light only the incoherent part of the lobe.
DirectPart direct_part(const CookedMaterial& cooked, const EvaluationLight& light) {
    const Grating& grating = cooked.material.grating;
    DirectPart part{.material = {.pitch_nm = grating.pitch_nm,
                                 .zero_order_xyz = cooked.zero_order_xyz,
                                 .lobe = grating.lobe,
                                 .cover = grating.cover},
                    .keys = {light.key_lights().begin(), light.key_lights().end()}};
    const auto* tables = std::get_if<StreakTables>(&cooked.tables);
    if (tables == nullptr) return part;
    if (!tables->incoherent) part.keys.clear();
    if (const auto rest = incoherent_part(grating)) part.material.lobe = rest->lobe;
    for (lighting::KeyLight& key : part.keys) key.flux *= 1.0 - tables->streak.power;
    return part;
}

/// XYZ of the probe's key lights. The shader refers to `cooked`.
PointShader key_light_shader(const CookedMaterial& cooked, const EvaluationLight& light) {
    DirectPart direct = direct_part(cooked, light);
    if (direct.keys.empty()) return [](const ShadingPoint&) { return glm::dvec3(0.0); };
    const Material& material = cooked.material;
    if (material.grating.lattice) {
        std::vector<LightPicture> pictures =
            key_light_pictures(material.grating, colour::LightSpectra(material.quality.illuminant), direct.keys);
        return [pictures = std::move(pictures), direct = std::move(direct)](const ShadingPoint& frame) {
            return pattern_radiance(pictures, direct.material.cover, direct.keys, frame);
        };
    }
    return [&cooked, direct = std::move(direct)](const ShadingPoint& frame) {
        return direct_radiance(cooked.kernel, direct.material, direct.keys, frame);
    };
}

/// The points as they are shaded: those of a sheet that transmits from behind.
std::vector<ShadingPoint> lit_points(const Grating& grating, std::span<const ShadingPoint> frames) {
    std::vector<ShadingPoint> points(frames.begin(), frames.end());
    if (grating.transmission) std::transform(points.begin(), points.end(), points.begin(), lit_from_behind);
    return points;
}

/// The sum of `shader` and the key lights, times the cover's transmittance toward the eye, T(v_n). Refers to `cooked`.
PointShader with_key_lights(PointShader shader, const CookedMaterial& cooked, const EvaluationLight& light) {
    return [shader = std::move(shader), key_lights = key_light_shader(cooked, light),
            &cover = cooked.material.grating.cover](const ShadingPoint& frame) {
        const glm::dvec3 xyz = shader(frame) + key_lights(frame);
        return cover ? xyz * transmittance(cover, glm::dot(glm::normalize(frame.view), glm::normalize(frame.normal)))
                     : xyz;
    };
}

/// `parallel`: several threads may call the shader at once.
std::vector<glm::dvec3> shade(const std::string& title, const PointShader& shader, const Grating& grating,
                              std::span<const ShadingPoint> frames, bool parallel) {
    const std::vector<ShadingPoint> points = lit_points(grating, frames);
    std::vector<glm::dvec3> xyz(points.size());
    Progress progress(title, points.size());
    const auto shade_point = [&](std::size_t i) {
        xyz[i] = shader(points[i]);
        progress.advance();
    };
    if (parallel)
        parallel_for(points.size(), shade_point);
    else
        for (std::size_t i = 0; i < points.size(); ++i) shade_point(i);
    return xyz;
}

}  // namespace

std::vector<glm::dvec3> evaluate_points(const std::string& title, const PointShader& shader,
                                        const CookedMaterial& cooked, const EvaluationLight& light,
                                        std::span<const ShadingPoint> frames) {
    return shade(title, with_key_lights(shader, cooked, light), cooked.material.grating, frames, true);
}

PointShader baked_shader(const CookedMaterial& cooked, const EvaluationLight& light) {
    const MaterialKernel kernel{.kernel = cooked.kernel,
                                .pitch_nm = cooked.material.grating.pitch_nm,
                                .zero_order_xyz = cooked.zero_order_xyz,
                                .cover = cooked.material.grating.cover};
    return with_key_lights(
        std::visit([&](const auto& tables) { return point_shader(tables, kernel, light); }, cooked.tables), cooked,
        light);
}

namespace {

std::vector<glm::dvec3> evaluate_side(const CookedMaterial& cooked, const EvaluationLight& light,
                                      std::span<const ShadingPoint> frames) {
    // All cores fill a plane's map, so the points are shaded one after the other.
    return shade(info(cooked.tables).name, baked_shader(cooked, light), cooked.material.grating, frames,
                 !info(cooked.tables).needs_flat_surface);
}

}  // namespace

void add_reflected_side(const CookedMaterial& cooked, const EvaluationLight& light,
                        std::span<const ShadingPoint> frames, std::vector<glm::dvec3>& xyz) {
    if (!cooked.reflected) return;
    const std::vector<glm::dvec3> reflected = evaluate_side(*cooked.reflected, light, frames);
    for (std::size_t i = 0; i < xyz.size(); ++i) xyz[i] += reflected[i];
}

namespace {

/// Unit vectors nearer than this are equal.
constexpr double kSameAxis = 1e-6;

}  // namespace

GrooveLayout layout_of(std::span<const ShadingPoint> points) {
    const auto agree = [&](glm::dvec3 ShadingPoint::*axis) {
        return std::ranges::all_of(points, [&](const ShadingPoint& point) {
            return glm::distance(glm::normalize(points.front().*axis), glm::normalize(point.*axis)) < kSameAxis;
        });
    };
    if (!agree(&ShadingPoint::normal)) return GrooveLayout::Curved;
    return agree(&ShadingPoint::grating) ? GrooveLayout::FlatUniform : GrooveLayout::Flat;
}

BakedTables drawn_tables(const BakedTables& tables, GrooveLayout layout) {
    const auto* planar = std::get_if<PlanarTables>(&tables);
    if (planar == nullptr) return tables;
    if (layout == GrooveLayout::Curved) return ArcTable(*planar->stand_in);
    PlanarTables result = *planar;
    if (layout == GrooveLayout::FlatUniform && result.lobe && result.lobe->size.azimuths > 1)
        result.lobe->size = one_azimuth(result.lobe->size);
    return result;
}

CookedMaterial as_drawn(const CookedMaterial& cooked, GrooveLayout layout) {
    CookedMaterial result = cooked;
    result.tables = drawn_tables(cooked.tables, layout);
    if (cooked.reflected)
        result.reflected = std::make_shared<const CookedMaterial>(as_drawn(*cooked.reflected, layout));
    return result;
}

namespace {

/// Indices of the points, plane by plane, grouped by the layout of the plane that each lies in.
std::map<GrooveLayout, std::vector<std::size_t>> indices_by_layout(std::span<const ShadingPoint> frames) {
    std::map<std::array<double, 3>, std::vector<std::size_t>> planes;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const glm::dvec3 n = glm::round(glm::normalize(frames[i].normal) / (0.5 * kSameAxis));
        planes[{n.x, n.y, n.z}].push_back(i);
    }
    std::map<GrooveLayout, std::vector<std::size_t>> result;
    for (const auto& [normal, indices] : planes) {
        std::vector<ShadingPoint> points;
        for (const std::size_t i : indices) points.push_back(frames[i]);
        std::vector<std::size_t>& of_layout = result[layout_of(points)];
        of_layout.insert(of_layout.end(), indices.begin(), indices.end());
    }
    return result;
}

}  // namespace

std::vector<glm::dvec3> evaluate_baked(const CookedMaterial& cooked, const EvaluationLight& light,
                                       std::span<const ShadingPoint> frames) {
    if (!info(cooked.tables).needs_flat_surface) return evaluate_baked(cooked, light, frames, GrooveLayout::Flat);
    std::vector<glm::dvec3> xyz(frames.size());
    for (const auto& [layout, indices] : indices_by_layout(frames)) {
        std::vector<ShadingPoint> points;
        for (const std::size_t i : indices) points.push_back(frames[i]);
        const std::vector<glm::dvec3> part = evaluate_baked(cooked, light, points, layout);
        for (std::size_t i = 0; i < part.size(); ++i) xyz[indices[i]] = part[i];
    }
    return xyz;
}

std::vector<glm::dvec3> evaluate_baked(const CookedMaterial& cooked, const EvaluationLight& light,
                                       std::span<const ShadingPoint> frames, GrooveLayout layout) {
    const CookedMaterial drawn = as_drawn(cooked, layout);
    std::vector<glm::dvec3> xyz = evaluate_side(drawn, light, frames);
    add_reflected_side(drawn, light, frames, xyz);
    return xyz;
}

PointShader exact_spikes(const Grating& grating, const SpikeSettings& settings, const EvaluationLight& light) {
    return in_tangent_frame(light.harmonics(settings.bands),
                            [baker = std::make_shared<const SpikeBaker>(grating, settings)](
                                const lighting::ShLight& rotated, const glm::dvec3& view) {
                                return evaluate_spikes(baker->bake(view.x, view.y), rotated);
                            });
}

PointComparer::PointComparer(lighting::ProbeImage probe, int key_lights)
    : probe_(std::make_unique<const lighting::ProbeImage>(std::move(probe))),
      fitted_(key_lights),
      lights_(*probe_, 0, key_lights) {}

lighting::ShLight PointComparer::harmonics(int key_lights, int bands) {
    return lights_.split(std::min(key_lights, fitted_)).harmonics(bands);
}

PointComparison PointComparer::compare(const std::shared_ptr<const CookedMaterial>& cooked,
                                       math::SphericalWindow window, const ShadingPoint& frame, GrooveLayout layout) {
    const EvaluationLight& lit = lights_.split(std::min(cooked->material.quality.key_lights, fitted_), window);
    if (!ready_ || ready_->cooked != cooked || ready_->layout != layout || ready_->light != &lit) {
        auto drawn = std::make_unique<const CookedMaterial>(as_drawn(*cooked, layout));
        PointShader shader = baked_shader(*drawn, lit);
        ready_.emplace(Ready{cooked, layout, &lit, std::move(drawn), std::move(shader)});
    }
    const CookedMaterial& drawn = *ready_->drawn;
    const std::array points{frame};
    const colour::LightSpectra spectra(cooked->material.quality.illuminant);
    PointComparison result;
    std::vector<glm::dvec3> shown{ready_->shader(lit_points(cooked->material.grating, points)[0])};
    add_reflected_side(drawn, lit, points, shown);
    result.shown = shown[0];
    result.reference = reference_radiance(cooked->material.grating, *probe_, spectra, points)[0];
    result.error = relative_rms(std::span(&result.shown, 1), std::span(&result.reference, 1));
    return result;
}

}  // namespace rowland::diffraction
