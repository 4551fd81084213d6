
#include "engine/gpu/pipeline_state.h"
#include "tests/gpu/call_counts.h"
#include "tests/gpu/gl_test.h"

namespace rowland {
namespace {

using BufferTest = test::GlTest;

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

TEST_F(BufferTest, DeletesItsName) {
    GLuint name = 0;
    {
        const gpu::Buffer buffer(std::vector<std::byte>(16));
        name = buffer.id();
        EXPECT_EQ(glIsBuffer(name), GL_TRUE);
    }
    EXPECT_EQ(glIsBuffer(name), GL_FALSE);
}

TEST_F(BufferTest, FeedsAUniformBlock) {
    const std::array values{glm::vec4(0.25F, 2.0F, -3.0F, 1.0F)};
    const gpu::Buffer block = gpu::Buffer::of(std::span<const glm::vec4>(values));
    block.bind_uniform(3);
    const gpu::Program program = build_full_screen(R"(#version 450 core
layout(std140, binding = 3) uniform Values { vec4 value; };
layout(location = 0) out vec4 colour;
void main() { colour = value; })");
    const gpu::Framebuffer target({.width = 1, .height = 1});
    gpu::FullScreenTriangle().draw(program, target);
    EXPECT_EQ(target.read_rgba_float()[0], values[0]);
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

class StreamBufferTest : public test::GlTest {
 protected:
    static constexpr int kDraws = 40;

    /// A pixel of the buffer's value at `offset`.
    void draw_pixel(const gpu::StreamBuffer& buffer, int pixel, std::size_t offset = 0) {
        buffer.bind_storage(3, offset, sizeof(glm::vec4));
        target_.bind();
        gpu::apply({.depth_test = gpu::DepthTest::Off,
                    .depth_write = false,
                    .cull = gpu::Cull::None,
                    .scissor = gpu::Scissor{.x = pixel, .y = 0, .width = 1, .height = 1}});
        program_.use();
        triangle_.draw(3);
    }
    static std::vector<glm::vec4> values(std::size_t count, float value) {
        return std::vector<glm::vec4>(count, glm::vec4(value));
    }
    void expect_the_numbers_of_the_pixels() const {
        const std::vector<glm::vec4> pixels = target_.read_rgba_float();
        for (int i = 0; i < kDraws; ++i) EXPECT_EQ(pixels[static_cast<std::size_t>(i)].r, static_cast<float>(i)) << i;
    }

    gpu::Program program_ = build_full_screen(R"(#version 450 core
layout(std430, binding = 3) readonly buffer Values { vec4 value; };
layout(location = 0) out vec4 colour;
void main() {
    float x = value.x;
    for (int i = 0; i < 20000; ++i) x = min(x, value.x + float(i));  // the GPU is late
    colour = vec4(x);
})");
    gpu::Framebuffer target_{gpu::FramebufferDesc{.width = kDraws, .height = 1, .colours = {gpu::Format::RGBA32F}}};
    gpu::VertexArray triangle_;
};

TEST_F(StreamBufferTest, EveryDrawReadsWhatWasWrittenBeforeIt) {
    gpu::StreamBuffer buffer;
    for (int i = 0; i < kDraws; ++i) {
        buffer.write_values(std::span<const glm::vec4>(values(1, static_cast<float>(i))));
        draw_pixel(buffer, i);
    }
    expect_the_numbers_of_the_pixels();
}

TEST_F(StreamBufferTest, ContentMayGrowAndShrink) {
    gpu::StreamBuffer buffer;
    for (int i = 0; i < kDraws; ++i) {
        const auto count = static_cast<std::size_t>(i % 7 == 0 ? 16 * (i + 1) : 16);
        buffer.write_values(std::span<const glm::vec4>(values(count, static_cast<float>(i))));
        EXPECT_EQ(buffer.size(), count * sizeof(glm::vec4));
        draw_pixel(buffer, i, (count - 16) * sizeof(glm::vec4));
    }
    expect_the_numbers_of_the_pixels();
}

TEST_F(StreamBufferTest, TexelsAreWhatWasWrittenLast) {
    const gpu::Program program = build_full_screen(R"(#version 450 core
layout(binding = 3) uniform samplerBuffer values;
layout(location = 0) out vec4 colour;
void main() { colour = texelFetch(values, textureSize(values) - 1); })");
    gpu::StreamBuffer buffer;
    for (int i = 0; i < 10; ++i) {
        const auto count = static_cast<std::size_t>(i % 7 == 0 ? 16 * (i + 1) : 16);
        std::vector<glm::vec3> written(count, glm::vec3(-1.0F));
        written.back() = glm::vec3(i, 2 * i, 3 * i);
        buffer.write_values(std::span<const glm::vec3>(written));
        if (i % 3 == 0) buffer.bind_texels(3);  // of the memory that it moves from
        if (i % 2 == 0)
            for (int frame = 0; frame < gpu::StreamBuffer::kFramesToMove; ++frame) buffer.keep();
        buffer.bind_texels(3);
        target_.bind();
        gpu::apply({.depth_test = gpu::DepthTest::Off, .depth_write = false, .cull = gpu::Cull::None});
        program.use();
        triangle_.draw(3);
        EXPECT_EQ(glm::vec3(target_.read_rgba_float()[0]), written.back()) << i;
    }
}

TEST_F(StreamBufferTest, MakesABufferInTheFirstTwoWritesAndWhereContentDoesNotFit) {
    gpu::StreamBuffer buffer;
    test::CallCounts calls;
    const auto made_for = [&](std::size_t count) {
        buffer.write_values(std::span<const glm::vec4>(values(count, 0.0F)));
        const test::CallCounts::Counts counts = calls.take();
        EXPECT_EQ(counts.copied, 0);
        return counts.made;
    };
    EXPECT_EQ(made_for(32), 1);
    EXPECT_EQ(made_for(32), 1);
    for (int i = 0; i < 10; ++i) EXPECT_EQ(made_for(32), 0);
    EXPECT_EQ(made_for(33), 1);
    for (int i = 0; i < 10; ++i) EXPECT_EQ(made_for(48 - static_cast<std::size_t>(i)), 0) << "half as much again fits";
    EXPECT_EQ(buffer.writes(), 23);
}

TEST_F(StreamBufferTest, ContentThatFramesKeepMovesOnce) {
    gpu::StreamBuffer buffer;
    test::CallCounts calls;
    for (int i = 0; i < kDraws; ++i) {
        buffer.write_values(std::span<const glm::vec4>(values(32, static_cast<float>(i))));
        calls.take();
        for (int frame = 1; frame < 3 * gpu::StreamBuffer::kFramesToMove; ++frame) {
            buffer.keep();
            const bool moves = i > 0 && frame == gpu::StreamBuffer::kFramesToMove;  // the first content need not
            const test::CallCounts::Counts counts = calls.take();
            EXPECT_EQ(counts.made, moves ? 1 : 0) << i << ", " << frame;
            EXPECT_EQ(counts.copied, moves ? 1 : 0) << i << ", " << frame;
            EXPECT_EQ(counts.waits, 0) << i << ", " << frame;
        }
        draw_pixel(buffer, i, 31 * sizeof(glm::vec4) / gpu::kBufferAlignment * gpu::kBufferAlignment);
    }
    expect_the_numbers_of_the_pixels();
}

}  // namespace
}  // namespace rowland
