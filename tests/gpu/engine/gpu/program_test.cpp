#include <gmock/gmock.h>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "tests/gpu/gl_test.h"
#include "tests/support/files.h"

namespace rowland {
namespace {

using ProgramTest = test::GlTest;
using ::testing::HasSubstr;

constexpr std::array kProgramFiles{
    EmbeddedFile{"t/broken.frag.glsl",
                 "#version 450 core\n"
                 "#include \"good.glsl\"\n"
                 "#include \"broken.glsl\"\n"
                 "layout(location = 0) out vec4 colour;\n"
                 "void main() { colour = vec4(good() + broken()); }\n"},
    EmbeddedFile{"t/broken_after_include.frag.glsl",
                 "#version 450 core\n"
                 "#include \"good.glsl\"\n"
                 "layout(location = 0) out vec4 colour;\n"
                 "void main() {\n"
                 "    colour = vec4(nowhere);\n"
                 "}\n"},
    EmbeddedFile{"t/good.glsl", "float good() { return 1.0; }\n\n\n"},
    EmbeddedFile{"t/broken.glsl", "// first\n\nfloat broken() {\n    return undeclared_name;\n}\n"},
    EmbeddedFile{"t/unlinkable.frag.glsl",
                 "#version 450 core\n"
                 "layout(location = 0) out vec4 colour;\n"
                 "vec4 never_defined();\n"
                 "void main() { colour = never_defined(); }\n"},
    EmbeddedFile{"t/defined.frag.glsl",
                 "#version 450 core\n"
                 "layout(location = 0) out vec4 colour;\n"
                 "void main() { colour = vec4(VALUE); }\n"},
};

gpu::ShaderLibrary program_library() {
    gpu::ShaderLibrary result;
    result.add_embedded(kProgramFiles);
    return result;
}

ErrorInfo program_failure(const std::string& fragment, std::vector<gpu::Define> defines = {}) {
    try {
        const gpu::Program program(
            program_library(),
            {.vertex = gpu::full_screen_vertex_shader, .fragment = fragment, .defines = std::move(defines)});
    } catch (const Error& error) {
        return error.info();
    }
    return {};
}

TEST_F(ProgramTest, CompileErrorNamesTheIncludedFileAndItsLine) {
    const ErrorInfo info = program_failure("t/broken.frag.glsl");
    EXPECT_EQ(info.file, "t/broken.glsl");
    EXPECT_EQ(info.location, "line 4");
    EXPECT_THAT(info.found, HasSubstr("undeclared_name"));
}

TEST_F(ProgramTest, CompileErrorBelowAnIncludeNamesTheOuterFileAndLine) {
    const ErrorInfo info = program_failure("t/broken_after_include.frag.glsl", {{"ONE", "1"}, {"TWO", "2"}});
    EXPECT_EQ(info.file, "t/broken_after_include.frag.glsl");
    EXPECT_EQ(info.location, "line 5");
    EXPECT_THAT(info.found, HasSubstr("nowhere"));
}

TEST_F(ProgramTest, LinkErrorNamesTheFiles) {
    const ErrorInfo info = program_failure("t/unlinkable.frag.glsl");
    EXPECT_THAT(info.file, HasSubstr("t/unlinkable.frag.glsl"));
    EXPECT_THAT(info.found, HasSubstr("never_defined"));
}

TEST_F(ProgramTest, DefinesReachTheShader) {
    const gpu::Program program(
        program_library(),
        {.vertex = gpu::full_screen_vertex_shader, .fragment = "t/defined.frag.glsl", .defines = {{"VALUE", "0.75"}}});
    const gpu::Framebuffer target(gpu::FramebufferDesc{});
    gpu::FullScreenTriangle().draw(program, target);
    EXPECT_EQ(target.read_rgba_float()[0].r, 0.75F);
}

TEST_F(ProgramTest, UniformsOfEveryTypeArrive) {
    const gpu::Program program = build_full_screen(R"(#version 450 core
uniform int a;
uniform float b;
uniform ivec2 c;
uniform vec2 d;
uniform vec3 e;
uniform vec4 f;
uniform mat3 g;
uniform mat4 h;
uniform float i[3];
uniform vec3 j[2];
uniform vec4 k[2];
uniform int l[2];
layout(location = 0) out vec4 scalars;
layout(location = 1) out vec4 vectors;
layout(location = 2) out vec4 arrays;
void main() {
    scalars = vec4(a, b, c.y, d.y);
    vectors = vec4(e.z, f.w, g[2][1], h[3][0]);
    arrays = vec4(i[2], j[1].y, k[1].w, l[1]);
})");
    const std::array i{1.0F, 2.0F, 3.0F};
    const std::array j{glm::vec3(1, 2, 3), glm::vec3(4, 5, 6)};
    const std::array k{glm::vec4(1), glm::vec4(2, 3, 4, 5)};
    const std::array l{1, 2};
    glm::mat3 g(0.0F);
    g[2][1] = 9.0F;
    glm::mat4 h(0.0F);
    h[3][0] = 10.0F;
    program.set("a", 1);
    program.set("b", 2.5F);
    program.set("c", glm::ivec2(3, 4));
    program.set("d", glm::vec2(5, 6));
    program.set("e", glm::vec3(0, 0, 7));
    program.set("f", glm::vec4(0, 0, 0, 8));
    program.set("g", g);
    program.set("h", h);
    program.set("i", std::span<const float>(i));
    program.set("j", std::span<const glm::vec3>(j));
    program.set("k", std::span<const glm::vec4>(k));
    program.set("l", std::span<const int>(l));
    const gpu::Framebuffer target({.colours = {gpu::Format::RGBA32F, gpu::Format::RGBA32F, gpu::Format::RGBA32F}});
    gpu::FullScreenTriangle().draw(program, target);
    EXPECT_EQ(target.read_rgba_float(0)[0], glm::vec4(1.0F, 2.5F, 4.0F, 6.0F));
    EXPECT_EQ(target.read_rgba_float(1)[0], glm::vec4(7.0F, 8.0F, 9.0F, 10.0F));
    EXPECT_EQ(target.read_rgba_float(2)[0], glm::vec4(3.0F, 5.0F, 5.0F, 2.0F));
}

TEST_F(ProgramTest, UniformsNothingReadsAreIgnored) {
    const gpu::Program program = build_full_screen(R"(#version 450 core
uniform float used;
layout(location = 0) out vec4 colour;
void main() { colour = vec4(used); })");
    EXPECT_TRUE(program.has_uniform("used"));
    EXPECT_FALSE(program.has_uniform("unused"));
    program.set("unused", 1.0F);  // would end the program if it were an error of the driver
}

using gpu::ShaderLibrary;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::array files{
    EmbeddedFile{"a/main.glsl", "// comment\n#version 450 core\n#include \"part.glsl\"\nmain line 4\n"},
    EmbeddedFile{"a/part.glsl", "#include \"b/deep.glsl\"\npart line 2\n"},
    EmbeddedFile{"b/deep.glsl", "deep line 1\n  #  include \"../a/part.glsl\" // once is enough\ndeep line 3"},
    EmbeddedFile{"a/lost.glsl", "#version 450 core\n\n#include \"prat.glsl\"\n"},
    EmbeddedFile{"a/early.glsl", "#include \"part.glsl\"\n#version 450 core\n"},
    EmbeddedFile{"a/bare.glsl", "void main() {}\n"},
    EmbeddedFile{"a/twice.glsl", "#version 450 core\n#include \"bare_version.glsl\"\n"},
    EmbeddedFile{"a/bare_version.glsl", "#version 450 core\n"},
    EmbeddedFile{"a/cpp.glsl", "#version 450 core\r\n#ifdef __cplusplus\r\n#include <cstdint>\r\n#endif\r\nlast\r\n"},
    EmbeddedFile{"a/both.glsl",
                 "#version 450 core\n#ifdef __cplusplus\n#pragma once\n#include \"none.h\"\n#ifdef X\nnested\n#else\n"
                 "nested\n#endif\nstruct Block {\n#else\n#ifdef Y\nuniform Block {\n#else\nbuffer Block {\n#endif\n"
                 "#endif\n"},
};

ShaderLibrary library() {
    ShaderLibrary result;
    result.add_embedded(files);
    return result;
}

std::string failure(const std::string& name) {
    try {
        library().assemble(name);
    } catch (const Error& error) {
        return error.what();
    }
    return "no failure";
}

TEST(ShaderLibrary, PastesIncludesOnceAndKeepsTrackOfLines) {
    const gpu::ShaderText result = library().assemble("a/main.glsl");
    EXPECT_THAT(result.files, ElementsAre("a/main.glsl", "a/part.glsl", "b/deep.glsl"));
    EXPECT_EQ(result.text,
              "// comment\n#version 450 core\n#line 3\n"
              "#line 100001\n"
              "#line 200001\ndeep line 1\n#line 200003\ndeep line 3\n"
              "#line 100002\npart line 2\n"
              "#line 4\nmain line 4\n");
}

TEST(ShaderLibrary, DefinesFollowTheVersion) {
    const std::array<gpu::Define, 2> defines{gpu::Define{"BANDS", "5"}, gpu::Define{"FLAT", ""}};
    EXPECT_THAT(library().assemble("a/main.glsl", defines).text,
                HasSubstr("#version 450 core\n#define BANDS 5\n#define FLAT \n#line 3\n"));
}

TEST(ShaderLibrary, LinesOfCppAreBlankAndKeepTheirNumbers) {
    EXPECT_EQ(library().assemble("a/cpp.glsl").text, "#version 450 core\n#line 2\n\n\n\nlast\n");
    EXPECT_EQ(library().assemble("a/both.glsl").text,
              "#version 450 core\n#line 2\n\n\n\n\n\n\n\n\n\n\n#ifdef Y\nuniform Block {\n#else\nbuffer Block {\n"
              "#endif\n\n");
}

TEST(ShaderLibrary, MissingIncludeNamesFileAndLine) {
    EXPECT_THAT(failure("a/lost.glsl"), HasSubstr("a/lost.glsl: line 3: #include \"prat.glsl\""));
}

TEST(ShaderLibrary, MissingFileSuggestsTheNearest) {
    EXPECT_THAT(failure("a/mian.glsl"), HasSubstr("did you mean a/main.glsl?"));
}

TEST(ShaderLibrary, VersionMustComeFirstAndOnce) {
    EXPECT_THAT(failure("a/early.glsl"), HasSubstr("a/early.glsl: line 1"));
    EXPECT_THAT(failure("a/bare.glsl"), HasSubstr("no #version"));
    EXPECT_THAT(failure("a/twice.glsl"), HasSubstr("a/bare_version.glsl: line 1: #version 450 core"));
}

TEST(ShaderLibrary, SourceFolderComesBeforeWhatIsBuiltIn) {
    const test::TemporaryFolder folder;
    write_file_atomic(folder.path() / "a" / "part.glsl", "from disk\n");
    ShaderLibrary shaders = library();
    shaders.set_source_folder(folder.path());
    EXPECT_THAT(shaders.assemble("a/main.glsl").text, HasSubstr("from disk\n"));
    write_file_atomic(folder.path() / "a" / "part.glsl", "changed on disk\n");
    EXPECT_THAT(shaders.assemble("a/main.glsl").text, HasSubstr("changed on disk\n"));
    shaders.set_source_folder(std::nullopt);
    EXPECT_THAT(shaders.assemble("a/main.glsl").text, HasSubstr("part line 2\n"));
}

TEST(CompileLog, KnowsTheFormsDriversUse) {
    const std::vector<std::string> names{"main.glsl", "part.glsl"};
    const auto messages = gpu::parse_compile_log(
        "0:3(1): warning: unused\n"
        "0:100012(5): error: `x' undeclared\n"
        "0(100007) : error C1008: undefined variable \"y\"\n"
        "ERROR: 0:9: 'z' : undeclared identifier\n"
        "0:700001(1): error: no such file\n"
        "\n"
        "2 compilation errors.\n",
        names);
    ASSERT_EQ(messages.size(), 6U);
    EXPECT_EQ(messages[0].file, "part.glsl");
    EXPECT_EQ(messages[0].line, 12U);
    EXPECT_EQ(messages[0].text, "error: `x' undeclared");
    EXPECT_EQ(messages[1].file, "part.glsl");
    EXPECT_EQ(messages[1].line, 7U);
    EXPECT_EQ(messages[2].file, "main.glsl");
    EXPECT_EQ(messages[2].line, 9U);
    EXPECT_EQ(messages[3].file, "");
    EXPECT_EQ(messages[3].text, "0:700001(1): error: no such file");
    EXPECT_EQ(messages[5].text, "warning: unused");  // errors come first
}

}  // namespace
}  // namespace rowland
