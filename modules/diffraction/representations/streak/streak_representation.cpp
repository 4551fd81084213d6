#include "modules/diffraction/representations/streak/streak_representation.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <memory>

#include "engine/core/error.h"
#include "engine/lighting/prefilter.h"
#include "modules/diffraction/bake/cube_pyramid.h"

namespace rowland::diffraction {

const RepresentationInfo& StreakSurfaceSettings::info() {
    static const RepresentationInfo info{
        .name = "streak",
        .summary = "narrow lobes: the whole probe, mirrored along the grooves",
        .lobes = Lobes::Mirroring,
        .key_lights = KeyLightUse::Always,
        .settings = {{.key = "nodes",
                      .label = "Nodes",
                      .help = "Wavelength nodes for each order.",
                      .minimum = 1,
                      .maximum = 32,
                      .default_value = StreakSettings().nodes_per_order,
                      .details = {4, 8, 16}},
                     {.key = "taps",
                      .label = "Taps",
                      .help = "Look-ups across the lobe.",
                      .minimum = 1,
                      .maximum = kMostStreakTaps,
                      .default_value = StreakSurfaceSettings().taps,
                      .sweep = {1, 2, 5, 9},
                      .details = {1, 3, 5}},
                     bands_setting(),
                     rank_setting(),
                     view_resolution_setting()},
        .editor_start = {"nodes", "taps"},
        .budget = [](bool flat_lobe, SurfaceShape) {
            std::vector<std::string> settings;
            for (const int nodes : {4, 8, 16})
                for (const int taps : {1, 3, 5})
                    if (!flat_lobe) settings.push_back(fmt::format("nodes={}/taps={}", nodes, taps));
            return settings;
        }};
    return info;
}

std::optional<Refusal> StreakSurfaceSettings::refusal(const SettingValues& values, const Grating& grating) {
    const std::size_t nodes = grating.orders.size() * static_cast<std::size_t>(values.number("nodes"));
    if (nodes <= kMostStreakNodes) return std::nullopt;
    return Refusal{"nodes", fmt::format("{} nodes for all orders", nodes), fmt::format("at most {}", kMostStreakNodes),
                   "take fewer nodes or list fewer orders"};
}

StreakSurfaceSettings StreakSurfaceSettings::from(const SettingValues& values, const Grating& grating) {
    StreakSurfaceSettings settings{.streak = {.nodes_per_order = values.number("nodes")},
                                   .taps = values.number("taps")};
    if (incoherent_rest(grating))
        settings.rest = ArcSettings{.bands = values.number("bands"),
                                    .rank = values.number("rank"),
                                    .grid = view_grid(values, default_view_grid(grating.lobe))};
    return settings;
}

void StreakSurfaceSettings::set_illuminant(const colour::Illuminant& white) {
    streak.illuminant = white;
    if (rest) rest->illuminant = white;
}

StreakTables bake(const Grating& grating, const StreakSurfaceSettings& settings) {
    StreakTables tables{.streak = make_streak(grating, settings.streak), .taps = settings.taps};
    if (settings.rest) tables.rest = bake(incoherent_rest(grating).value(), *settings.rest);
    return tables;
}

void write(const StreakTables& tables, ByteWriter& writer) {
    write(tables.streak, writer);
    if (tables.rest) write(*tables.rest, writer);
}

StreakTables read(ByteReader& reader, const StreakSurfaceSettings& settings) {
    StreakTables tables{.streak = read_streak(reader), .taps = settings.taps};
    if (settings.rest) tables.rest = read(reader, *settings.rest);
    return tables;
}

ShadingCost cost(const StreakTables& tables) {
    constexpr std::size_t kNodeBytes = 64;
    const int taps = most_seen_nodes(tables.streak) * tables.taps;
    ShadingCost result = tables.rest ? cost(*tables.rest) : ShadingCost{};
    result.fetches_per_pixel += kStreakFilterTaps * taps;
    result.multiply_adds_per_pixel +=
        taps * (40 + 6 * kStreakFilterTaps) + 12 * static_cast<int>(tables.streak.nodes.size());
    result.table_bytes += tables.streak.nodes.size() * kNodeBytes;
    return result;
}

Facts facts(const StreakTables& tables) {
    Facts result{{"streak", fmt::format("{} nodes, {} taps", tables.streak.nodes.size(), tables.taps)}};
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
    return [pyramid = std::make_shared<const CubePyramid>(lighting::prefilter(*light.probe())), &tables, rest,
            cover = material.cover](const ShadingPoint& frame) {
        const glm::dmat3 tangent = world_to_tangent(frame);
        const glm::dmat3 to_world = glm::transpose(tangent);
        const auto radiance = [&](const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b) {
            return pyramid->filtered(to_world * direction, to_world * a, to_world * b, kStreakFilterTaps);
        };
        const glm::dvec3 view = tangent * glm::normalize(frame.view);
        return evaluate(tables.streak, radiance, view, tables.taps, cover) + (1.0 - tables.streak.power) * rest(frame);
    };
}

}  // namespace rowland::diffraction
