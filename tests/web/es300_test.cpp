// Every representation's programs in the dialect of WebGL 2, through the reference front end.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/core/file.h"
#include "engine/gpu/shader_library.h"
#include "engine/render/shader_files.h"
#include "modules/diffraction/shaders/shader_files.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace rowland {
namespace {

using Defines = std::vector<gpu::Define>;

struct Program {
    std::string name;
    std::string vertex;    ///< beneath modules/diffraction
    std::string fragment;  ///< likewise
    Defines defines;
};

/// As the GPU class of each representation describes its programs.
std::vector<Program> programs() {
    const std::string pixels = "shaders/pixel_shaded.vert.glsl";
    const std::string vertices = "shaders/vertex_shaded.frag.glsl";
    const Defines line{{"VIEW_MAPPING", "2"}, {"TABLE_COLUMNS", "128"}, {"TABLE_ROWS", "1"}, {"LAYERS", "2"}};
    const Defines plane{{"VIEW_MAPPING", "1"}, {"TABLE_COLUMNS", "64"}, {"TABLE_ROWS", "64"}};
    const auto with = [](Defines defines, const Defines& more) {
        defines.insert(defines.end(), more.begin(), more.end());
        return defines;
    };
    return {
        {"spikes", "representations/spikes/spikes.vert.glsl", vertices,
         with(plane, {{"VERTEX_SHADED", "1"}, {"BANDS", "5"}, {"SPIKES", "8"}})},
        {"bins", "representations/bins/bins.vert.glsl", vertices,
         with(plane, {{"VERTEX_SHADED", "1"}, {"BANDS", "5"}, {"BINS", "8"}})},
        {"transfer", "representations/transfer/transfer.vert.glsl", vertices,
         with(plane, {{"VERTEX_SHADED", "1"}, {"BANDS", "5"}})},
        {"arc", "representations/arc/arc.vert.glsl", "representations/arc/arc.frag.glsl", line},
        {"arc_turns", pixels, "representations/arc/arc.frag.glsl",
         with(line,
              {{"TURNS", "5"}, {"PITCH_AXIS", "1"}, {"GROOVE_MAP", "uv"}, {"HAS_UV", ""}, {"GROOVES_EVEN", "1"}})},
        {"direct", pixels, "representations/direct/direct.frag.glsl", {{"LOBE_GAUSSIAN", "1"}}},
        {"planar", pixels, "representations/planar/planar.frag.glsl", {}},
        {"planar_volume",
         pixels,
         "representations/planar/planar.frag.glsl",
         {{"LOBE_MAP", "1"}, {"HALF_TURN", "1"}, {"LOBE_PITS", "1"}}},
        {"planar_at_vertices", "representations/planar/planar.vert.glsl", vertices, {{"VERTEX_SHADED", "1"}}},
        {"circle",
         pixels,
         "representations/circle/circle.frag.glsl",
         {{"CHARTS", "2"}, {"VIEWS", "64"}, {"REST_VIEWS", "40"}, {"ANGLES", "14"}}},
        {"streak",
         pixels,
         "representations/streak/streak.frag.glsl",
         {{"STREAK", "1"}, {"NODES", "7"}, {"LOBE_GAUSSIAN", "1"}}},
        {"streak_rest", "representations/arc/arc.vert.glsl", "representations/streak/streak.frag.glsl",
         with(plane, {{"STREAK", "1"}, {"NODES", "7"}, {"REST", "1"}, {"LAYERS", "2"}, {"LOBE_PITS", "1"}})},
    };
}

/// Lights and covers in different stages.
const std::vector<Defines>& surroundings() {
    static const std::vector<Defines> all{
        {},
        {{"SEPARATE_LIGHTS", "1"}, {"COVER", "1"}},
        {{"SEPARATE_LIGHTS", "1"}, {"KEY_LOBE_WINDOWS", "1"}, {"COVER", "1"}},
        {{"SEPARATE_LIGHTS", "1"},
         {"ZERO_ORDER", "1"},
         {"DIRECTIONAL_LIGHTS", "1"},
         {"PUNCTUAL_LIGHTS", "1"},
         {"SHADOWS", "1"}},
        {{"SEPARATE_LIGHTS", "1"}, {"LIGHTS_AT_VERTICES", "1"}, {"DIRECTIONAL_LIGHTS", "1"}},
    };
    return all;
}

/// The grooves of a texture turn from pixel to pixel, so vertices do not shade their lights.
bool exists(const Program& program, const Defines& around) {
    return program.name != "arc_turns" || around.size() < 2 || around[1].first != "LIGHTS_AT_VERTICES";
}

TEST(Es300, EveryRepresentationsProgramsCompileAndLink) {
    if (test::run({"/usr/bin/env", "glslangValidator", "--version"}).code != 0)
        GTEST_SKIP() << "needs glslangValidator (Debian: glslang-tools)";
    gpu::ShaderLibrary shaders;
    shaders.add_embedded(render::shader_files());
    shaders.add_embedded(diffraction::shader_files());
    const test::TemporaryFolder folder;
    int linked = 0;
    for (const Program& program : programs())
        for (const Defines& around : surroundings()) {
            if (!exists(program, around)) continue;
            Defines defines = program.defines;
            defines.insert(defines.end(), around.begin(), around.end());
            const auto write = [&](const std::string& file, const char* stage) {
                const std::string text =
                    shaders.assemble("modules/diffraction/" + file, defines, gpu::Dialect::Es300).text;
                EXPECT_TRUE(text.starts_with("#version 300 es\n"));
                write_file_atomic(folder.path() / stage, std::string_view(text));
            };
            write(program.vertex, "stage.vert");
            write(program.fragment, "stage.frag");
            const test::Ended ended = test::run({"/usr/bin/env", "glslangValidator", "-l", "stage.vert", "stage.frag"},
                                                {.folder = folder.path()});
            EXPECT_EQ(ended.code, 0) << program.name << "\n" << ended.out;
            ++linked;
        }
    EXPECT_EQ(linked, 59);
}

}  // namespace
}  // namespace rowland
