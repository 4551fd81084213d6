#include <epoxy/gl.h>

#include <array>

#include "engine/gpu/buffer.h"
#include "tests/gpu/gl_test.h"

namespace rowland {

namespace {

using BufferTest = test::GlTest;
using BufferDeathTest = test::GlTest;

template <std::size_t Count>
std::array<float, Count> read_back(const gpu::Buffer& buffer) {
    std::array<float, Count> values{};
    glGetNamedBufferSubData(buffer.id(), 0, sizeof(values), values.data());
    return values;
}

TEST_F(BufferTest, HoldsWhatWasPutIn) {
    const std::array<float, 3> values{1.0F, -2.5F, 3e8F};
    const gpu::Buffer buffer = gpu::Buffer::of(std::span<const float>(values));
    EXPECT_EQ(buffer.size(), sizeof(values));
    EXPECT_EQ(read_back<3>(buffer), values);
}

TEST_F(BufferTest, UpdatesOnlyTheBytesNamed) {
    gpu::Buffer buffer(4 * sizeof(float));
    const std::array<float, 2> values{5.0F, 6.0F};
    buffer.update(std::as_bytes(std::span(values)), sizeof(float));
    EXPECT_EQ(read_back<4>(buffer), (std::array<float, 4>{0.0F, 5.0F, 6.0F, 0.0F}));
}

TEST_F(BufferTest, MovedFromOwnsNothing) {
    gpu::Buffer first(16);
    const GLuint name = first.id();
    const gpu::Buffer second = std::move(first);
    EXPECT_EQ(second.id(), name);
    EXPECT_EQ(first.id(), 0U);  // NOLINT: the state after a move is what is tested
}

TEST_F(BufferTest, DeletesItsName) {
    GLuint name = 0;
    {
        const gpu::Buffer buffer(16);
        name = buffer.id();
        EXPECT_EQ(glIsBuffer(name), GL_TRUE);
    }
    EXPECT_EQ(glIsBuffer(name), GL_FALSE);
}

TEST_F(BufferTest, FeedsAUniformBlock) {
    gpu::Buffer block(sizeof(glm::vec4));
    block.update_value(glm::vec4(0.25F, 2.0F, -3.0F, 1.0F));
    block.bind_uniform(3);
    const gpu::Program program = build_full_screen(R"(#version 450 core
layout(std140, binding = 3) uniform Values { vec4 value; };
layout(location = 0) out vec4 colour;
void main() { colour = value; })");
    const gpu::Framebuffer target({.width = 1, .height = 1});
    gpu::FullScreenTriangle().draw(program, target);
    EXPECT_EQ(target.read_rgba_float()[0], glm::vec4(0.25F, 2.0F, -3.0F, 1.0F));
}

TEST_F(BufferTest, TakesWhatAComputeProgramWrites) {
    const gpu::ShaderLibrary library = [] {
        static constexpr std::array files{EmbeddedFile{"test.comp.glsl", R"(#version 450 core
layout(local_size_x = 4) in;
layout(std430, binding = 2) buffer Values { float values[]; };
void main() { values[gl_GlobalInvocationID.x] *= FACTOR; })"}};
        gpu::ShaderLibrary result;
        result.add_embedded(files);
        return result;
    }();
    const gpu::Program program(library, {.compute = "test.comp.glsl", .defines = {{"FACTOR", "3.0"}}});
    const std::array<float, 4> values{1.0F, 2.0F, 3.0F, 4.0F};
    const gpu::Buffer buffer = gpu::Buffer::of(std::span<const float>(values));
    buffer.bind_storage(2);
    program.dispatch(1);
    EXPECT_EQ(read_back<4>(buffer), (std::array<float, 4>{3.0F, 6.0F, 9.0F, 12.0F}));
}

TEST_F(BufferDeathTest, RefusesUpdatesThatDoNotFit) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const std::array<std::byte, 8> bytes{};
    EXPECT_DEATH(gpu::Buffer(8).update(bytes, 1), "contract violated.*8 and 7");
    EXPECT_DEATH(gpu::Buffer(8, gpu::BufferUse::Static).update(bytes), "a static buffer is not updated");
}

}  // namespace

}  // namespace rowland
