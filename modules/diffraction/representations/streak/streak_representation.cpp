#include "modules/diffraction/representations/streak/streak_representation.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <memory>

#include "engine/core/error.h"
#include "engine/lighting/light_samples.h"

namespace rowland::diffraction {

const RepresentationInfo& StreakSurfaceSettings::info() {
    static const RepresentationInfo info{
        .name = "streak",
        .summary = "narrow lobes and lattices: the whole probe, mirrored along the grooves",
        .lobes = Lobes::Mirroring,
        .lattices = true,
        .key_lights = KeyLightUse::Always,
        .settings = {map_resolution_setting(StreakSettings().map_resolution, 512, {128, 192, 256}, {128, 192, 320}),
                     bands_setting(), rank_setting(), view_resolution_setting()},
        .replaced = {{"nodes", "map_resolution"}, {"taps", "map_resolution"}},
        .editor_start = {"map_resolution"},
        .budget = [](bool flat_lobe, SurfaceShape) -> std::vector<std::string> {
            if (flat_lobe) return {};
            return {"map_resolution=128", "map_resolution=192", "map_resolution=320"};
        }};
    return info;
}

StreakSurfaceSettings StreakSurfaceSettings::from(const SettingValues& values, const Grating& grating) {
    StreakSurfaceSettings settings{.streak = {.map_resolution = values.number("map_resolution")},
                                   .lattice = grating.lattice.has_value()};
    if (incoherent_rest(grating))
        settings.rest = ArcSettings{.bands = values.number("bands"),
                                    .rank = values.number("rank"),
                                    .grid = view_grid(values, default_view_grid(grating))};
    return settings;
}

void StreakSurfaceSettings::set_illuminant(const colour::Illuminant& white) {
    streak.illuminant = white;
    if (rest) rest->illuminant = white;
}

StreakTables bake(const Grating& grating, const StreakSurfaceSettings& settings) {
    if (grating.lattice)
        return {.map = lattice_map_size(settings.streak.map_resolution),
                .lattice = make_lattice_streak(grating, settings.streak)};
    StreakTables tables{.streak = make_streak(grating, settings.streak), .map = {}};
    tables.map = map_size(tables.streak, settings.streak.map_resolution);
    if (settings.rest) tables.rest = bake(incoherent_rest(grating).value(), *settings.rest);
    return tables;
}

void write(const StreakTables& tables, ByteWriter& writer) {
    if (tables.lattice) {
        write(*tables.lattice, writer);
        return;
    }
    write(tables.streak, writer);
    if (tables.rest) write(*tables.rest, writer);
}

StreakTables read(ByteReader& reader, const StreakSurfaceSettings& settings) {
    if (settings.lattice)
        return {.map = lattice_map_size(settings.streak.map_resolution), .lattice = read_lattice_streak(reader)};
    StreakTables tables{.streak = read_streak(reader), .map = {}};
    tables.map = map_size(tables.streak, settings.streak.map_resolution);
    if (settings.rest) tables.rest = read(reader, *settings.rest);
    return tables;
}

namespace {

std::size_t segment_count(const StreakTables& tables) {
    return tables.lattice ? tables.lattice->segments.size() : tables.streak.segments.size();
}

}  // namespace

ShadingCost cost(const StreakTables& tables) {
    constexpr std::size_t kHalfTexel = 8;
    constexpr int kLevelsPerLookUp = 2;
    const std::size_t segments = segment_count(tables);
    const int nodes = tables.lattice ? most_seen_nodes(*tables.lattice) : most_seen_nodes(tables.streak);
    ShadingCost result = tables.rest ? cost(*tables.rest) : ShadingCost{};
    result.fetches_per_pixel += kLevelsPerLookUp * nodes;
    result.multiply_adds_per_pixel += 22 * nodes + 150 * static_cast<int>(segments);
    const auto side = static_cast<std::size_t>(tables.map.side);
    const std::size_t finest = 2 * side * side * static_cast<std::size_t>(tables.map.turns) * kHalfTexel;
    result.table_bytes += finest + finest / 8 + finest / 64 + segments * sizeof(StreakSegment);
    return result;
}

Facts facts(const StreakTables& tables) {
    Facts result{{"streak", fmt::format("{} nodes, map {} x {} x {}", kSegmentNodes * segment_count(tables),
                                        2 * tables.map.side, tables.map.side, tables.map.turns)}};
    if (tables.rest)
        for (auto& fact : facts(*tables.rest)) result.push_back(std::move(fact));
    return result;
}

PointShader point_shader(const StreakTables& tables, const MaterialKernel& material, const EvaluationLight& light) {
    if (!light.probe())
        throw Error({.file = "--probe-sh",
                     .location = {},
                     .found = "band-limited light",
                     .expected = "a probe for streaks",
                     .remedy = "give --probe"});
    PointShader rest = [](const ShadingPoint&) { return glm::dvec3(0.0); };
    if (tables.rest) rest = point_shader(*tables.rest, material, light);
    return
        [map = std::make_shared<const StreakMap>(fill_streak_map(lighting::light_samples(*light.probe()), tables.map)),
         &tables, rest, cover = material.cover](const ShadingPoint& frame) {
            const glm::dmat3 tangent = world_to_tangent(frame);
            const glm::dvec3 view = tangent * glm::normalize(frame.view);
            if (tables.lattice) return evaluate(*tables.lattice, *map, glm::transpose(tangent), view, cover);
            return evaluate(tables.streak, *map, glm::transpose(tangent), view, cover) +
                   (1.0 - tables.streak.power) * rest(frame);
        };
}

}  // namespace rowland::diffraction
