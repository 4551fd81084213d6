#include "modules/diffraction/representations/circle/circle.h"

#include <fmt/format.h>

#include <algorithm>

#include "modules/diffraction/bake/diffraction_pattern.h"

namespace rowland::diffraction {

namespace {

SettingInfo angles_setting() {
    return {.key = "angles",
            .label = "Angles of the normal",
            .help =
                "At how many angles of half a turn the map holds what a series to 2t lacks, t the normal's angle "
                "about the grating vector (14 by default, 8 under a cover); 0: nothing.",
            .minimum = 0,
            .maximum = 24,
            .sweep = {0, 8, 20}};
}

/// Counted in circle_map.glsl, without signs and selections: p, t and t2 10, coordinates of the terms 8, scale 3.
constexpr int kPositionMultiplyAdds = 21;
/// Likewise, of the series' rest: the position on its axis 9, coordinates 7, mix 6, scale and sum 6.
constexpr int kRestMultiplyAdds = 28;

/// The kernel needs about 128 views, however soft the light; more where g is resolved as finely.
int views_of(int side) {
    return std::max(std::min(2 * side, 128), 5 * side / 4);
}

}  // namespace

const RepresentationInfo& CircleSettings::info() {
    static const RepresentationInfo info{
        .name = "circle",
        .summary = "one map for all objects of any shape, of the whole probe",
        .lobes = Lobes::Flat,
        .is_map = true,
        .settings = {map_resolution_setting(104, 128, {16, 24, 32, 48, 64, 80}, {16, 48, 104}), angles_setting()},
        .editor_start = {"map_resolution"},
        .sweep_tier = "map_resolution=104/key_lights=16",
        .sweep_key_lights = {0, 1, 2, 4, 8, 32},
        // Flat surfaces have a better map; beyond 104 a map takes more than 64 MB.
        .budget = [](bool flat_lobe, SurfaceShape surface) -> std::vector<std::string> {
            if (!flat_lobe || surface != SurfaceShape::Curved) return {};
            return {"map_resolution=16",  "map_resolution=24",          "map_resolution=32",
                    "map_resolution=48",  "map_resolution=64",          "map_resolution=80",
                    "map_resolution=104", "map_resolution=48/angles=0", "map_resolution=104/angles=0"};
        }};
    return info;
}

std::optional<Refusal> CircleSettings::refusal(const SettingValues&, const Grating&) {
    return std::nullopt;
}

CircleSettings CircleSettings::from(const SettingValues& values, const Grating& grating) {
    const int side = values.number("map_resolution");
    return {.size = {.side = side,
                     .views = views_of(side),
                     .angles = values.number_or("angles", circle_angles(grating.cover))},
            .charts = is_even(grating) ? 1 : 2,
            .covered = grating.cover.has_value()};
}

CircleTables bake(const Grating&, const CircleSettings& settings) {
    return {settings.size, settings.charts, settings.covered};
}

void write(const CircleTables&, ByteWriter&) {}

CircleTables read(ByteReader&, const CircleSettings& settings) {
    return {settings.size, settings.charts, settings.covered};
}

ShadingCost cost(const CircleTables& tables) {
    constexpr std::size_t kHalfTexel = 8;
    constexpr std::size_t kRestTexel = 4;
    const auto nodes = [&](int side, int views) {
        return static_cast<std::size_t>(tables.charts * views) * static_cast<std::size_t>(side * side);
    };
    const CircleMapSize& size = tables.size;
    const auto angles = static_cast<std::size_t>(rest_angles(size.angles, tables.covered));
    return {.fetches_per_pixel = kTermLookUps + (angles > 0 ? 2 : 0),
            .multiply_adds_per_pixel = 3 * kCircleTerms + kPositionMultiplyAdds + (angles > 0 ? kRestMultiplyAdds : 0),
            .table_bytes = nodes(size.side, size.views) * kTermLookUps * kHalfTexel +
                           nodes(rest_side(size.side), rest_views(size.views)) * angles * kRestTexel};
}

Facts facts(const CircleTables& tables) {
    return {{"map", fmt::format("{0} x {0} x {1}, {2} angles", tables.size.side, tables.size.views,
                                rest_angles(tables.size.angles, tables.covered))}};
}

PointShader point_shader(const CircleTables& tables, const MaterialKernel& material, const EvaluationLight& light) {
    return
        [map = fill_circle_map(light.texels(), material.kernel, material.pitch_nm, tables.size, material.zero_order_xyz,
                               material.cover)](const ShadingPoint& frame) { return sample(map, frame); };
}

}  // namespace rowland::diffraction
