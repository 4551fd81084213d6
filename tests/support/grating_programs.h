#pragma once

// The programs of gratings: every define that names a way to shade, in the combinations that exist.

#include <algorithm>
#include <string>
#include <vector>

#include "engine/gpu/shader_library.h"

namespace rowland::test {

using Defines = std::vector<gpu::Define>;

struct GratingProgram {
    std::string name;
    int samplers;  ///< at most, of the fragment stage's own code
    Defines defines;
};

inline gpu::Define shader_file(const char* define, const std::string& path) {
    return {define, "\"modules/diffraction/" + path + '"'};
}

/// As the GPU class of each representation describes its programs.
inline std::vector<GratingProgram> grating_programs() {
    const Defines line{{"VIEW_MAPPING", "2"}, {"TABLE_COLUMNS", "128"}, {"TABLE_ROWS", "1"}, {"LAYERS", "2"}};
    const Defines of_rank_16{{"VIEW_MAPPING", "2"}, {"TABLE_COLUMNS", "128"}, {"TABLE_ROWS", "1"}, {"LAYERS", "4"}};
    const Defines plane{{"VIEW_MAPPING", "1"}, {"TABLE_COLUMNS", "64"}, {"TABLE_ROWS", "64"}};
    const auto at_pixels = [](const char* path, Defines defines, const Defines& more = {}) {
        defines.push_back(shader_file("PROBE_LIGHT", path));
        defines.insert(defines.end(), more.begin(), more.end());
        return defines;
    };
    const auto at_vertices = [](const char* path, Defines defines) {
        defines.push_back({"VERTEX_SHADED", "1"});
        defines.push_back(shader_file("VERTEX_LIGHT", path));
        return defines;
    };
    const char* const arc = "representations/arc/arc.glsl";
    const char* const planar = "representations/planar/planar.glsl";
    const char* const streak = "representations/streak/streak.glsl";
    Defines spikes = at_vertices("representations/spikes/spikes.glsl", plane);
    spikes.insert(spikes.end(), {{"BANDS", "5"}, {"SPIKES", "8"}});
    return {
        {"spikes", 2, spikes},
        {"arc", 3, at_pixels(arc, line, {{"ARC_PRODUCTS", "1"}})},
        {"arc_of_rank_16", 3, at_pixels(arc, of_rank_16, {{"ARC_PRODUCTS", "1"}})},
        {"arc_of_rank_16_grooves", 3,
         at_pixels(arc, of_rank_16,
                   {{"ARC_PRODUCTS", "1"},
                    {"PITCH_AXIS", "1"},
                    {"GROOVE_MAP", "uv"},
                    {"HAS_UV", ""},
                    {"GROOVES_EVEN", "1"}})},
        {"arc_turns", 3,
         at_pixels(arc, of_rank_16,
                   {{"TURNS", "5"}, {"PITCH_AXIS", "1"}, {"GROOVE_MAP", "uv"}, {"HAS_UV", ""}, {"GROOVES_EVEN", "1"}})},
        {"direct", 2, {{"LOBE_GAUSSIAN", "1"}}},
        {"planar", 3, at_pixels(planar, {})},
        {"planar_volume", 3, at_pixels(planar, {{"LOBE_MAP", "1"}, {"HALF_TURN", "1"}, {"LOBE_PITS", "1"}})},
        {"planar_pit_sequence", 3,
         at_pixels(planar, {{"LOBE_MAP", "1"}, {"HALF_TURN", "1"}, {"LOBE_PIT_SEQUENCE", "16"}})},
        {"planar_sparkle", 3,
         at_pixels(planar, {shader_file("GROOVE_SPARKLE", "shaders/sparkle.glsl")},
                   {{"LOBE_MAP", "1"},
                    {"HALF_TURN", "1"},
                    {"LOBE_GAUSSIAN", "1"},
                    {"GROOVE_MAP", "uv"},
                    {"HAS_UV", ""},
                    {"GROOVES_EVEN", "1"},
                    {"GROOVE_GAPS", "1"},
                    {"FINE_GROOVE_PARTS", "1"}})},
        {"planar_at_vertices", 2, at_vertices(planar, {})},
        {"circle", 4, at_pixels("representations/circle/circle.glsl", {{"CHARTS", "2"}, {"ANGLES", "14"}})},
        {"streak", 3, at_pixels(streak, {{"STREAK", "1"}, {"NODES", "7"}, {"LOBE_GAUSSIAN", "1"}})},
        {"streak_rest", 4,
         at_pixels(streak, plane,
                   {{"STREAK", "1"},
                    {"NODES", "7"},
                    {"REST", "1"},
                    {"LAYERS", "2"},
                    {"ARC_PRODUCTS", "1"},
                    {"LOBE_PITS", "1"}})},
    };
}

/// Lights and covers in different stages.
inline const std::vector<Defines>& grating_lights() {
    static const gpu::Define tables = shader_file("KEY_LOBES", "shaders/key_light_tables.glsl");
    static const gpu::Define windows = shader_file("KEY_LOBES", "shaders/key_light_windows.glsl");
    static const std::vector<Defines> all{
        {},
        {{"SEPARATE_LIGHTS", "1"}, tables, {"COVER", "1"}},
        {{"SEPARATE_LIGHTS", "1"}, windows, {"COVER", "1"}},
        {{"SEPARATE_LIGHTS", "1"},
         windows,
         {"ZERO_ORDER", "1"},
         {"DIRECTIONAL_LIGHTS", "1"},
         {"PUNCTUAL_LIGHTS", "1"},
         {"SHADOWS", "1"}},
        {{"SEPARATE_LIGHTS", "1"}, {"LIGHTS_AT_VERTICES", "1"}, tables, {"DIRECTIONAL_LIGHTS", "1"}},
    };
    return all;
}

/// The grooves of a texture turn from pixel to pixel, so neither vertices nor tables shade their lights.
inline bool exists(const GratingProgram& program, const Defines& around) {
    const auto has_grooves = [](const gpu::Define& define) { return define.first == "GROOVE_MAP"; };
    return std::ranges::none_of(program.defines, has_grooves) ||
           std::ranges::none_of(around, [](const gpu::Define& define) {
               return define.first == "LIGHTS_AT_VERTICES" || define.second.ends_with("key_light_tables.glsl\"");
           });
}

}  // namespace rowland::test
