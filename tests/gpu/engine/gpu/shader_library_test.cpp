#include "engine/gpu/shader_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/gpu/compile_log.h"
#include "tests/support/temporary_folder.h"

namespace rowland {

namespace {

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

TEST(ShaderLibrary, HoldsTheFullScreenTriangleFromTheStart) {
    EXPECT_THAT(ShaderLibrary().read("engine/gpu/shaders/full_screen_triangle.vert.glsl"), HasSubstr("gl_VertexID"));
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
