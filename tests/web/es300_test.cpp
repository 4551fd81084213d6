// Every representation's programs in the dialect of WebGL 2, through the reference front end.

#include "engine/core/file.h"
#include "engine/render/shader_interface.h"
#include "modules/diffraction/shaders/shader_files.h"
#include "tests/support/files.h"
#include "tests/support/grating_programs.h"
#include "tests/support/program.h"

namespace rowland {
namespace {

TEST(Es300, EveryRepresentationsProgramsCompileAndLink) {
    if (test::run({"/usr/bin/env", "glslangValidator", "--version"}).code != 0)
        GTEST_SKIP() << "needs glslangValidator (Debian: glslang-tools)";
    gpu::ShaderLibrary shaders;
    shaders.add_embedded(render::shader_files());
    shaders.add_embedded(diffraction::shader_files());
    const test::TemporaryFolder folder;
    int linked = 0;
    for (const test::GratingProgram& program : test::grating_programs())
        for (const test::Defines& around : test::grating_lights()) {
            if (!test::exists(program, around)) continue;
            test::Defines defines = program.defines;
            defines.insert(defines.end(), around.begin(), around.end());
            const auto write = [&](const std::string& name, const char* stage) {
                const std::string text =
                    shaders.assemble("modules/diffraction/shaders/" + name, defines, gpu::Dialect::Es300).text;
                EXPECT_TRUE(text.starts_with("#version 300 es\n"));
                write_file_atomic(folder.path() / stage, std::string_view(text));
            };
            write("grating.vert.glsl", "stage.vert");
            write("grating.frag.glsl", "stage.frag");
            const test::Ended ended = test::run({"/usr/bin/env", "glslangValidator", "-l", "stage.vert", "stage.frag"},
                                                {.folder = folder.path()});
            EXPECT_EQ(ended.code, 0) << program.name << "\n" << ended.out;
            ++linked;
        }
    EXPECT_EQ(linked, 64);
}

}  // namespace
}  // namespace rowland
