#include "engine/gpu/framebuffer.h"

#include <cmath>

#include "engine/gpu/pipeline_state.h"
#include "tests/gpu/gl_test.h"

namespace rowland {

namespace {

using FramebufferTest = test::GlTest;
using gpu::Format;

constexpr const char* uv_fragment = R"(#version 450 core
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 colour;
void main() { colour = vec4(uv, 0.5, 1.0); })";

constexpr const char* constant_fragment = R"(#version 450 core
layout(location = 0) out vec4 colour;
uniform vec4 value;
void main() { colour = value; })";

TEST_F(FramebufferTest, FirstRowReadIsTheTop) {
    const gpu::Framebuffer target({.width = 4, .height = 2, .colours = {Format::RGBA32F}});
    gpu::FullScreenTriangle().draw(build_full_screen(uv_fragment), target);
    const std::vector<glm::vec4> pixels = target.read_rgba_float();
    // Pixel centres; interpolated, so float rounding.
    EXPECT_NEAR(pixels[0].x, 0.125F, 1e-6F);
    EXPECT_NEAR(pixels[0].y, 0.75F, 1e-6F);
    EXPECT_NEAR(pixels[7].x, 0.875F, 1e-6F);
    EXPECT_NEAR(pixels[7].y, 0.25F, 1e-6F);
}

TEST_F(FramebufferTest, FullScreenTriangleCoversEveryPixelOnce) {
    const gpu::Framebuffer target({.width = 13, .height = 7, .colours = {Format::R32F}});
    target.clear(glm::vec4(-1.0F));
    const gpu::Program program = build_full_screen(constant_fragment);
    program.set("value", glm::vec4(2.0F));
    gpu::FullScreenTriangle().draw(program, target);
    for (const glm::vec4& pixel : target.read_rgba_float()) EXPECT_EQ(pixel.r, 2.0F);
}

TEST_F(FramebufferTest, FloatTargetsKeepNegativeAndHugeValues) {
    const gpu::Program program = build_full_screen(constant_fragment);
    program.set("value", glm::vec4(-3.5F, 60000.0F, 1e-7F, 1.0F));
    for (const Format format : {Format::RGBA16F, Format::RGBA32F}) {
        const gpu::Framebuffer target({.colours = {format}});
        gpu::FullScreenTriangle().draw(program, target);
        const glm::vec4 pixel = target.read_rgba_float()[0];
        EXPECT_EQ(pixel.r, -3.5F);
        EXPECT_EQ(pixel.g, 60000.0F);
        EXPECT_NEAR(pixel.b, 1e-7F, 6e-8F);  // the smallest half-float step: drivers may round either way
    }
}

TEST_F(FramebufferTest, EightBitTargetsRoundAndClamp) {
    const gpu::Framebuffer target({.colours = {Format::RGBA8}});
    const gpu::Program program = build_full_screen(constant_fragment);
    program.set("value", glm::vec4(-1.0F, 100.4F / 255.0F, 100.6F / 255.0F, 7.0F));
    gpu::FullScreenTriangle().draw(program, target);
    EXPECT_EQ(target.read_rgba8(), (std::vector<std::uint8_t>{0, 100, 101, 255}));
}

TEST_F(FramebufferTest, ReadingEightBitsFromFloatsClamps) {
    const gpu::Framebuffer target({.colours = {Format::RGBA32F}});
    target.clear({-1.0F, 0.0F, 1.0F, 2.0F});
    EXPECT_EQ(target.read_rgba8(), (std::vector<std::uint8_t>{0, 0, 255, 255}));
}

TEST_F(FramebufferTest, EachAttachmentGetsItsOwnOutput) {
    const gpu::Framebuffer target({.colours = {Format::RGBA16F, Format::RGBA32F}});
    gpu::FullScreenTriangle().draw(build_full_screen(R"(#version 450 core
layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
void main() { first = vec4(1.0); second = vec4(2.0); })"),
                                   target);
    EXPECT_EQ(target.read_rgba_float(0)[0], glm::vec4(1.0F));
    EXPECT_EQ(target.read_rgba_float(1)[0], glm::vec4(2.0F));
}

TEST_F(FramebufferTest, DrawsIntoOneLayerAndLevelOfATexture) {
    const gpu::Texture texture({.kind = gpu::TextureKind::PlaneArray,
                                .format = Format::RGBA32F,
                                .width = 4,
                                .height = 4,
                                .depth = 2,
                                .levels = 2});
    for (int layer = 0; layer < 2; ++layer) {
        for (int level = 0; level < 2; ++level) {
            const gpu::Framebuffer target = gpu::Framebuffer::onto(texture, level, layer);
            EXPECT_EQ(target.size(), texture.size(level));
            target.clear(glm::vec4(static_cast<float>(10 * level + layer)));
        }
    }
    EXPECT_EQ(texture.read({.level = 0, .layer = 1})[15].r, 1.0F);
    EXPECT_EQ(texture.read({.level = 1, .layer = 0})[3].r, 10.0F);
}

TEST_F(FramebufferTest, BlendAndDepthFollowThePipelineState) {
    const gpu::Framebuffer target({.depth = true});
    const gpu::Program program = build_full_screen(constant_fragment);
    const gpu::VertexArray vertices;
    const auto draw = [&](const gpu::PipelineState& state, float value) {
        gpu::apply(state);
        program.set("value", glm::vec4(value, 0.0F, 0.0F, 0.25F));
        program.use();
        target.bind();
        vertices.draw(3);
        return target.read_rgba_float()[0].r;
    };
    target.clear(glm::vec4(1.0F));
    target.clear_depth(0.25F);  // the triangle lies at 0.5, behind
    EXPECT_EQ(draw({}, 8.0F), 1.0F);
    EXPECT_EQ(draw({.depth_test = gpu::DepthTest::Off, .depth_write = false}, 8.0F), 8.0F);
    EXPECT_EQ(target.depth().read()[0].r, 0.25F);
    EXPECT_EQ(draw({.depth_test = gpu::DepthTest::Off, .blend = gpu::Blend::Add}, 2.0F), 10.0F);
    EXPECT_EQ(target.depth().read()[0].r, 0.5F);
    EXPECT_EQ(draw({.depth_test = gpu::DepthTest::Equal, .blend = gpu::Blend::Over}, 2.0F), 8.0F);
    EXPECT_EQ(draw({.depth_test = gpu::DepthTest::LessEqual, .blend = gpu::Blend::Premultiplied}, 1.0F), 7.0F);
    EXPECT_EQ(draw({.depth_test = gpu::DepthTest::Off, .cull = gpu::Cull::Front}, 3.0F), 7.0F);
}

TEST_F(FramebufferTest, ResolvingAveragesAnEdgesSamples) {
    // Half of the picture's triangle edge: a diagonal from corner to corner, so pixels on it are partly covered.
    constexpr const char* diagonal_vertex = R"(#version 450 core
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner * 0.97 - vec2(1.0, 0.9), 0.0, 1.0);
})";
    const gpu::Program program = build(diagonal_vertex, constant_fragment);
    const gpu::Framebuffer samples(
        {.width = 16, .height = 16, .colours = {Format::RGBA32F}, .depth = true, .samples = 4});
    const gpu::Framebuffer target({.width = 16, .height = 16, .colours = {Format::RGBA32F}});
    program.set("value", glm::vec4(8.0F));
    samples.bind();
    samples.clear(glm::vec4(0.0F));
    samples.clear_depth();
    gpu::apply({.cull = gpu::Cull::None});
    program.use();
    gpu::VertexArray().draw(3);
    samples.resolve_to(target);
    int partly = 0;
    for (const glm::vec4& pixel : target.read_rgba_float()) {
        EXPECT_EQ(pixel.r * 0.5F, std::round(pixel.r * 0.5F));  // a mean of four samples of 0 or 8
        partly += pixel.r > 0.0F && pixel.r < 8.0F ? 1 : 0;
    }
    EXPECT_GT(partly, 5);
}

}  // namespace

}  // namespace rowland
