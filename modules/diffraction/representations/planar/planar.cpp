#include "modules/diffraction/representations/planar/planar.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <memory>

namespace rowland::diffraction {

const RepresentationInfo& PlanarSettings::info() {
    static const RepresentationInfo info{
        .name = "planar",
        .summary = "one map for a flat object, of the whole probe",
        .lobes = Lobes::Flat,
        .is_map = true,
        .needs_flat_surface = true,
        .settings = {map_resolution_setting(128, 1024, {16, 32, 64, 256, 512}, {32, 128, 256}), bands_setting(),
                     rank_setting()},
        .editor_start = {"map_resolution"},
        .sweep_tier = "map_resolution=128/key_lights=16",
        .sweep_key_lights = {0, 4, 32},
        .sweep_more = {"map_resolution=64", "map_resolution=256", "map_resolution=512"},
        .budget = [](bool flat_lobe, SurfaceShape surface) -> std::vector<std::string> {
            if (!flat_lobe || surface != SurfaceShape::Flat) return {};
            return {"map_resolution=32", "map_resolution=64", "map_resolution=128", "map_resolution=256",
                    "map_resolution=512"};
        }};
    return info;
}

PlanarSettings PlanarSettings::from(const SettingValues& values, const Grating& grating) {
    const int views = values.number("map_resolution");
    return {
        .size = {.azimuths = views + views % 2, .views = views},
        .stand_in = {
            .bands = values.number("bands"), .rank = values.number("rank"), .grid = default_view_grid(grating.lobe)}};
}

PlanarTables bake(const Grating& grating, const PlanarSettings& settings) {
    return {settings.size, bake(grating, settings.stand_in)};
}

void write(const PlanarTables& tables, ByteWriter& writer) {
    write(tables.stand_in, writer);
}

PlanarTables read(ByteReader& reader, const PlanarSettings& settings) {
    return {settings.size, read(reader, settings.stand_in)};
}

ShadingCost cost(const PlanarTables& tables) {
    constexpr std::size_t kHalfTexel = 8;
    const auto texels = static_cast<std::size_t>(tables.size.azimuths) * static_cast<std::size_t>(tables.size.views);
    return {.fetches_per_pixel = 1,
            .multiply_adds_per_pixel = 12,
            .table_bytes = texels * kHalfTexel + cost(tables.stand_in).table_bytes};
}

Facts facts(const PlanarTables& tables) {
    Facts result{{"map", fmt::format("{} x {}", tables.size.azimuths, tables.size.views)}};
    for (auto& fact : facts(tables.stand_in)) result.push_back(std::move(fact));
    return result;
}

PointShader point_shader(const PlanarTables& tables, const MaterialKernel& material, const EvaluationLight& light) {
    struct Plane {
        glm::dvec3 normal{0.0};
        PlanarMap map;
    };
    return [material, size = tables.size, texels = light.texels(),
            last = std::make_shared<Plane>()](const ShadingPoint& frame) {
        const glm::dvec3 normal = glm::normalize(frame.normal);
        if (normal != last->normal)
            *last = {normal, fill_planar_map(texels, material.kernel, material.pitch_nm, normal, size,
                                             material.zero_order_xyz, material.cover)};
        return sample(last->map, frame);
    };
}

}  // namespace rowland::diffraction
