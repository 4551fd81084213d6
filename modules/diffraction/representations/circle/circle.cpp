#include "modules/diffraction/representations/circle/circle.h"

#include <fmt/format.h>

namespace rowland::diffraction {

const RepresentationInfo& CircleSettings::info() {
    static const RepresentationInfo info{
        .name = "circle",
        .summary = "one map for all objects of any shape, of the whole probe",
        .lobes = Lobes::Flat,
        .is_map = true,
        .settings = {map_resolution_setting(64, 128, {16, 24, 32, 48, 80}, {16, 32, 64})},
        .editor_start = {"map_resolution"},
        .sweep_tier = "map_resolution=64/key_lights=16",
        .sweep_key_lights = {0, 1, 2, 4, 8, 32},
        // Flat surfaces have a better map; beyond 64 a map takes hundreds of megabytes.
        .budget = [](bool flat_lobe, SurfaceShape surface) -> std::vector<std::string> {
            if (!flat_lobe || surface != SurfaceShape::Curved) return {};
            return {"map_resolution=16", "map_resolution=24", "map_resolution=32", "map_resolution=48",
                    "map_resolution=64"};
        }};
    return info;
}

CircleSettings CircleSettings::from(const SettingValues& values, const Grating& grating) {
    const int side = values.number("map_resolution");
    return {.size = {.side = side, .views = 2 * side, .terms = circle_terms(grating.cover)}};
}

CircleTables bake(const Grating&, const CircleSettings& settings) {
    return {settings.size};
}

void write(const CircleTables&, ByteWriter&) {}

CircleTables read(ByteReader&, const CircleSettings& settings) {
    return {settings.size};
}

ShadingCost cost(const CircleTables& tables) {
    constexpr std::size_t kHalfTexel = 8;
    const auto side = static_cast<std::size_t>(tables.size.side);
    const int look_ups = look_ups_of(tables.size.terms);
    return {.fetches_per_pixel = look_ups,
            .multiply_adds_per_pixel = 3 * tables.size.terms + 40,
            .table_bytes = 2 * side * side * static_cast<std::size_t>(tables.size.views) *
                           static_cast<std::size_t>(look_ups) * kHalfTexel};
}

Facts facts(const CircleTables& tables) {
    return {{"map", fmt::format("{0} x {0} x {1}, {2} terms", tables.size.side, tables.size.views, tables.size.terms)}};
}

PointShader point_shader(const CircleTables& tables, const MaterialKernel& material, const EvaluationLight& light) {
    return
        [map = fill_circle_map(light.texels(), material.kernel, material.pitch_nm, tables.size, material.zero_order_xyz,
                               material.cover)](const ShadingPoint& frame) { return sample(map, frame); };
}

}  // namespace rowland::diffraction
