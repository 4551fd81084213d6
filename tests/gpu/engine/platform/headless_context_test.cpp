#include "engine/platform/gl_context.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>

#include "engine/gpu/pipeline_state.h"
#include "tests/gpu/gl_test.h"
#include "tests/support/environment.h"
#include "tests/support/expect.h"

namespace rowland {

namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ContextTest = test::GlTest;

constexpr const char* triangle_vertex = R"(#version 450 core
layout(location = 0) in vec2 position;
layout(location = 1) in vec3 colour;
out vec3 vertex_colour;
void main() {
    vertex_colour = colour;
    gl_Position = vec4(position, 0.0, 1.0);
})";

constexpr const char* triangle_fragment = R"(#version 450 core
in vec3 vertex_colour;
layout(location = 0) out vec4 colour;
void main() { colour = vec4(vertex_colour, 1.0); }
)";

/// The lower left half of an 8×8 picture in one colour on black.
std::vector<glm::vec4> draw_triangle(const gpu::Program& program) {
    const std::vector<float> vertices{-1, -1, 0.25F, 0.5F, 2, 1, -1, 0.25F, 0.5F, 2, -1, 1, 0.25F, 0.5F, 2};
    const std::vector<std::uint32_t> indices{0, 1, 2};
    const gpu::Buffer vertex_buffer = gpu::Buffer::of(std::span<const float>(vertices));
    const gpu::Buffer index_buffer = gpu::Buffer::of(std::span<const std::uint32_t>(indices));
    gpu::VertexArray array;
    array.attach(vertex_buffer, 5 * sizeof(float), {{0, 2, 0}, {1, 3, 2 * sizeof(float)}});
    array.attach_indices(index_buffer);

    const gpu::Framebuffer target({.width = 8, .height = 8, .depth = true});
    target.bind();
    target.clear(glm::vec4(0.0F));
    target.clear_depth();
    gpu::apply({});
    program.use();
    array.draw_indexed(3);
    return target.read_rgba_float();
}

TEST_F(ContextTest, GivesOpenGl45Core) {
    GLint major = 0;
    GLint minor = 0;
    GLint profile = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_GE(10 * major + minor, 45);
    EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_FALSE(context_.renderer().empty());
    EXPECT_FALSE(context_.version().empty());
}

TEST_F(ContextTest, IsADebugContextWhereAskedForAndInDebugBuilds) {
    const auto is_debug = [] {
        GLint flags = 0;
        glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
        return (flags & GL_CONTEXT_FLAG_DEBUG_BIT) != 0;
    };
    EXPECT_TRUE(is_debug());
    const platform::HeadlessContext plain({.debug = false});
    EXPECT_FALSE(is_debug());
    const platform::HeadlessContext by_default;
    EXPECT_EQ(is_debug(), platform::debug_build());
}

TEST_F(ContextTest, DrawsATriangle) {
    const std::vector<glm::vec4> pixels = draw_triangle(build(triangle_vertex, triangle_fragment));
    // Rows run from the top: the lower left corner is in the last row, the upper right one in the first.
    EXPECT_EQ(pixels[7 * 8 + 0], glm::vec4(0.25F, 0.5F, 2.0F, 1.0F));
    EXPECT_EQ(pixels[0 * 8 + 7], glm::vec4(0.0F));
}

/// The other way to a GPU: that of machines whose GPU has no display. Mesa's software renderer is such a device.
TEST_F(ContextTest, AContextOnAnEglDeviceDraws) {
    std::optional<platform::HeadlessContext> context;
    try {
        context.emplace(platform::HeadlessOptions{.debug = true, .gpu = "egl software device"});
    } catch (const Error& error) {
        GTEST_SKIP() << error.what();
    }
    gpu::enable_debug_output(true);
    EXPECT_TRUE(context->is_software());
    EXPECT_EQ(draw_triangle(build(triangle_vertex, triangle_fragment))[56].b, 2.0F);
}

TEST_F(ContextTest, AGpuIsChosenByNumberOrPartOfItsName) {
    EXPECT_EQ(platform::HeadlessContext({.gpu = "0"}).renderer(), context_.renderer());
    EXPECT_EQ(platform::HeadlessContext({.gpu = context_.renderer()}).renderer(), context_.renderer());
}

TEST_F(ContextTest, AWrongChoiceListsTheGpus) {
    const std::string expected = fmt::format("0 = {}, ", context_.renderer());
    for (const char* wanted : {"no such", "99"}) {
        EXPECT_THAT(test::message_of([&] { const platform::HeadlessContext context({.gpu = wanted}); }),
                    AllOf(HasSubstr(fmt::format("no GPU \"{}\"", wanted)), HasSubstr(expected)));
        test::set_variable(platform::gpu_variable, wanted);
        EXPECT_THAT(test::message_of([] { const platform::HeadlessContext context; }),
                    HasSubstr("ROWLAND_GPU: no GPU"));
        test::set_variable(platform::gpu_variable, std::nullopt);
    }
}

TEST_F(ContextTest, ALaterContextWorksAfterAnEarlierOneIsGone) {
    for (int i = 0; i < 3; ++i) {
        const platform::HeadlessContext later({.debug = true});
        gpu::enable_debug_output(true);
        EXPECT_EQ(draw_triangle(build(triangle_vertex, triangle_fragment))[56].b, 2.0F);
    }
}

TEST_F(ContextTest, TwoContextsLiveSideBySide) {
    std::optional<platform::HeadlessContext> second(std::in_place);
    const GLuint in_second = build(triangle_vertex, triangle_fragment).id();
    EXPECT_NE(in_second, 0U);
    context_.make_current();
    second.reset();
    EXPECT_EQ(draw_triangle(build(triangle_vertex, triangle_fragment))[56].b, 2.0F);
}

}  // namespace

}  // namespace rowland
