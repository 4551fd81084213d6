#include "modules/diffraction/representations/planar/planar.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

namespace rowland::diffraction {

namespace {

/// A map of so many views takes 135 MB, or twice as many where orders m and −m differ.
constexpr int kMostLobeViews = 256;

/// Under lamps as small as texels the number of azimuths matters more than that of views: 128 views and 352 azimuths
/// take 23 MB.
int lobe_azimuths(int views) {
    constexpr int kMost = 512;
    return std::min(kMost, (11 * views / 4 + 3) / 4 * 4);
}

/// Keeps the error within 2 % under lamps as small as texels (PHYSICS §13).
constexpr int kLatticeViews = 256;

/// No lobe blurs the azimuths of a lattice: 128 views take 34 MB, 256 views 270 MB.
int lattice_azimuths(int views) {
    return 4 * views;
}

SettingInfo views_h_setting() {
    return {.key = "views_h",
            .label = "Nodes along v_h",
            .help =
                "Nodes of the map along the grooves, of a lobe that is not flat, or along h, of a lattice; "
                "map_resolution unless given.",
            .minimum = 8,
            .maximum = kMostLobeViews};
}

std::optional<PlanarLobe> lobe_of(const PlanarSettings& settings) {
    if (!settings.lobe_size) return std::nullopt;
    const LobeMapViews finest = one_azimuth(*settings.lobe_size).views;
    return PlanarLobe{*settings.lobe_size,
                      shaded_pattern(settings.grating, colour::LightSpectra(settings.stand_in.illuminant),
                                     0.25 * std::min(finest.step_g(), finest.step_h()))};
}

/// Shades each object by shader_of(normal, g) and keeps the shader of the last one. `one_azimuth`: points of another g
/// belong to another object.
template <typename ShaderOf>
PointShader by_object(bool one_azimuth, ShaderOf shader_of) {
    struct Object {
        glm::dvec3 normal{0.0};
        glm::dvec3 grating{0.0};
        PointShader shader;
    };
    return
        [one_azimuth, shader_of = std::move(shader_of), last = std::make_shared<Object>()](const ShadingPoint& frame) {
            const glm::dvec3 normal = glm::normalize(frame.normal);
            if (normal != last->normal || (one_azimuth && frame.grating != last->grating))
                *last = {normal, frame.grating, shader_of(normal, frame.grating)};
            return last->shader(frame);
        };
}

}  // namespace

const RepresentationInfo& PlanarSettings::info() {
    static const RepresentationInfo info{
        .name = "planar",
        .file_number = 4,
        .summary = "one map for a flat object, of the whole probe",
        .is_map = true,
        .lattices = true,
        .needs_flat_surface = true,
        .settings = {map_resolution_setting(128, 1024), views_h_setting(), bands_setting(), rank_setting()},
        .budget = [](const Grating& shown, SurfaceShape surface) -> std::vector<std::string> {
            if (surface != SurfaceShape::Flat) return {};
            if (shown.lattice) return {"map_resolution=64", "map_resolution=128", "map_resolution=256"};
            if (!sees_v_g_alone(shown)) return {"map_resolution=32", "map_resolution=64", "map_resolution=128"};
            return {"map_resolution=32",  "map_resolution=64",  "map_resolution=128",
                    "map_resolution=192", "map_resolution=256", "map_resolution=512"};
        }};
    return info;
}

std::optional<Refusal> PlanarSettings::refusal(const SettingValues& values, const Grating& grating) {
    if (sees_v_g_alone(grating)) {
        if (!values.has("views_h")) return std::nullopt;
        return Refusal{"views_h", fmt::format("{} with the flat groove_lobe", values.number_or("views_h", 0)),
                       "no views_h: the map of a flat lobe does not depend on v_h"};
    }
    if (values.number("map_resolution") <= kMostLobeViews) return std::nullopt;
    return Refusal{"map_resolution",
                   fmt::format("{} with {}", values.number("map_resolution"),
                               grating.lattice ? "a lattice" : "a groove_lobe that is not flat"),
                   fmt::format("at most {}, as the map is a volume", kMostLobeViews)};
}

PlanarSettings PlanarSettings::from(const SettingValues& values, const Grating& grating) {
    const int views =
        grating.lattice ? values.number_or("map_resolution", kLatticeViews) : values.number("map_resolution");
    PlanarSettings settings{
        .size = planar_map_size(views),
        .grating = grating,
        .stand_in = {
            .bands = values.number("bands"), .rank = values.number("rank"), .grid = default_view_grid(grating)}};
    if (!sees_v_g_alone(grating))
        settings.lobe_size = {.azimuths = grating.lattice ? lattice_azimuths(views) : lobe_azimuths(views),
                              .views = {.g = views, .h = values.number_or("views_h", views)}};
    return settings;
}

PlanarTables bake(const Grating& grating, const PlanarSettings& settings) {
    return {.size = settings.size,
            .lobe = lobe_of(settings),
            .stand_in = Lazy<ArcTable>([grating, stand_in = settings.stand_in] { return bake(grating, stand_in); })};
}

void write(const PlanarTables& tables, ByteWriter& writer) {
    write(*tables.stand_in, writer);
}

PlanarTables read(ByteReader& reader, const PlanarSettings& settings) {
    return {.size = settings.size, .lobe = lobe_of(settings), .stand_in = read(reader, settings.stand_in)};
}

ShadingCost cost(const PlanarTables& tables) {
    constexpr std::size_t kHalfTexel = 8;
    const auto of = [](int count) { return static_cast<std::size_t>(count); };
    const std::size_t texels = tables.lobe ? of(slices(tables.lobe->size, tables.lobe->pattern.even)) *
                                                 of(tables.lobe->size.views.g) * of(tables.lobe->size.views.h)
                                           : of(tables.size.azimuths) * of(tables.size.views) *
                                                 of(tables.size.pitch ? tables.size.pitch->nodes : 1);
    return {.fetches_per_pixel = 1, .multiply_adds_per_pixel = 12, .table_bytes = texels * kHalfTexel};
}

Facts facts(const PlanarTables& tables) {
    Facts result;
    if (tables.lobe)
        result.push_back({"map", fmt::format("{} x {} x {}", tables.lobe->size.azimuths, tables.lobe->size.views.g,
                                             tables.lobe->size.views.h)});
    else
        result.push_back({"map", fmt::format("{} x {}", tables.size.azimuths, tables.size.views)});
    if (tables.stand_in.is_computed())
        for (auto& fact : facts(*tables.stand_in)) result.push_back(std::move(fact));
    return result;
}

PointShader point_shader(const PlanarTables& tables, const MaterialKernel& material, const EvaluationLight& light) {
    if (!tables.lobe)
        return by_object(
            false, [material, size = tables.size, texels = light.texels()](const glm::dvec3& n, const glm::dvec3&) {
                return planar_map_of_points(texels, material.kernel, material.pitch_nm, n, size,
                                            material.zero_order_xyz, material.cover);
            });
    const LobeMapSize& size = tables.lobe->size;
    const auto spectrum = std::make_shared<const LobeSpectrum>(tables.lobe->pattern, size.views);
    return by_object(size.azimuths == 1,
                     [texels = light.texels(), azimuths = size.azimuths, spectrum](const glm::dvec3& n,
                                                                                   const glm::dvec3& g) -> PointShader {
                         if (azimuths > 1) return lobe_map_of_points(texels, *spectrum, n, azimuths);
                         return [map = fill_lobe_slice(texels, *spectrum, n, g)](const ShadingPoint& frame) {
                             return sample(map, frame);
                         };
                     });
}

}  // namespace rowland::diffraction
