#include "modules/diffraction/representations/circle/circle.h"

#include <fmt/format.h>

#include <algorithm>

#include "modules/diffraction/bake/diffraction_pattern.h"

namespace rowland::diffraction {

namespace {

/// Multiples of the angle that maps have in air.
constexpr int kMultiplesInAir = 4;

SettingInfo angle_multiples_setting() {
    return {.key = "angle_multiples",
            .label = "Multiples of the angle",
            .help =
                "How many multiples of the normal's angle t about the grating vector the map has terms of: of t, 2t, "
                "4t, 6t (3 by default); under a cover of t, 2t, 4t, 3t, 5t (all by default).",
            .minimum = 2,
            .maximum = 5,
            .sweep = {2, 4}};
}

int rounded_up_to_even(int count) {
    return count + count % 2;
}

/// The kernel needs about 128 views, however soft the light; more where g is resolved as finely.
int views_of(int side) {
    return std::max(std::min(2 * side, 128), rounded_up_to_even(5 * side / 4));
}

}  // namespace

const RepresentationInfo& CircleSettings::info() {
    static const RepresentationInfo info{
        .name = "circle",
        .summary = "one map for all objects of any shape, of the whole probe",
        .lobes = Lobes::Flat,
        .is_map = true,
        .settings = {map_resolution_setting(112, 128, {16, 24, 32, 48, 64, 80}, {16, 48, 112}),
                     angle_multiples_setting()},
        .editor_start = {"map_resolution"},
        .sweep_tier = "map_resolution=112/key_lights=16",
        .sweep_key_lights = {0, 1, 2, 4, 8, 32},
        // Flat surfaces have a better map; beyond 112 a map takes more than 64 MB.
        .budget = [](bool flat_lobe, SurfaceShape surface) -> std::vector<std::string> {
            if (!flat_lobe || surface != SurfaceShape::Curved) return {};
            return {"map_resolution=16",
                    "map_resolution=24",
                    "map_resolution=32",
                    "map_resolution=48",
                    "map_resolution=64",
                    "map_resolution=80",
                    "map_resolution=112",
                    "map_resolution=48/angle_multiples=2",
                    "map_resolution=112/angle_multiples=2",
                    "map_resolution=112/angle_multiples=4"};
        }};
    return info;
}

std::optional<Refusal> CircleSettings::refusal(const SettingValues& values, const Grating& grating) {
    const int multiples = values.number_or("angle_multiples", 2);
    if (grating.cover || multiples <= kMultiplesInAir) return std::nullopt;
    return Refusal{"angle_multiples", fmt::format("{} without a cover", multiples),
                   fmt::format("at most {}: in air the series has no odd multiples from 3 on", kMultiplesInAir)};
}

CircleSettings CircleSettings::from(const SettingValues& values, const Grating& grating) {
    const int side = rounded_up_to_even(values.number("map_resolution"));
    return {.size = {.side = side,
                     .views = views_of(side),
                     .terms = 1 + 2 * values.number_or("angle_multiples", circle_terms(grating.cover) / 2)},
            .charts = is_even(grating) ? 1 : 2};
}

CircleTables bake(const Grating&, const CircleSettings& settings) {
    return {settings.size, settings.charts};
}

void write(const CircleTables&, ByteWriter&) {}

CircleTables read(ByteReader&, const CircleSettings& settings) {
    return {settings.size, settings.charts};
}

ShadingCost cost(const CircleTables& tables) {
    constexpr std::size_t kHalfTexel = 8;
    const auto side = static_cast<std::size_t>(tables.size.side);
    const std::size_t nodes =
        static_cast<std::size_t>(tables.charts) * side * side * static_cast<std::size_t>(tables.size.views);
    const auto [fine, coarse] = look_ups_of(tables.size.terms);
    const std::size_t texels = nodes * static_cast<std::size_t>(std::max(fine, coarse));
    return {.fetches_per_pixel = fine + coarse,
            .multiply_adds_per_pixel = 3 * tables.size.terms + 50,
            .table_bytes = (texels + (coarse > 0 ? texels / 8 : 0)) * kHalfTexel};
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
