#include "engine/gpu/pipeline_state.h"

#include <random>

#include "tests/gpu/call_counts.h"
#include "tests/gpu/gl_test.h"

namespace rowland {

namespace {

using gpu::PipelineState;

constexpr const char* kShowsTheTexture = R"(#version 450 core
layout(binding = 0) uniform sampler2D source;
uniform float factor;
layout(location = 0) out vec4 colour;
void main() { colour = factor * texelFetch(source, ivec2(0), 0); })";

gpu::Texture texel(float value) {
    gpu::Texture texture({.format = gpu::Format::RGBA32F});
    texture.upload(std::vector<glm::vec4>{glm::vec4(value)});
    return texture;
}

class BoundStateTest : public test::GlTest {
 protected:
    float shown() {
        triangle_.draw(program_, target_);
        return target_.read_rgba_float()[0].r;
    }

    gpu::Program program_ = build_full_screen(kShowsTheTexture);
    gpu::Framebuffer target_{gpu::FramebufferDesc{.colours = {gpu::Format::RGBA32F}}};
    gpu::FullScreenTriangle triangle_;
};

TEST_F(BoundStateTest, WhatIsSetIsNotSetAgain) {
    const gpu::Texture texture = texel(1.0F);
    const gpu::Buffer buffer(std::vector<std::byte>(512));
    const auto set_all = [&] {
        texture.bind(0);
        buffer.bind_uniform(3, 256, 16);
        program_.set("factor", 2.0F);
        triangle_.draw(program_, target_);
    };
    set_all();
    test::CallCounts calls;
    set_all();
    EXPECT_EQ(calls.take().set, 0);
    buffer.bind_uniform(3, 0, 16);
    program_.set("factor", 3.0F);
    EXPECT_EQ(calls.take().set, 2);
    gpu::forget_bound_state();
    set_all();
    EXPECT_GT(calls.take().set, 10);
}

// Mesa gives names of deleted objects to no others for long; other drivers do at once.
TEST_F(BoundStateTest, ADeletedObjectIsForgotten) {
    using Slot = gpu::BoundState::Slot;
    std::optional<gpu::Texture> texture = texel(1.0F);
    std::optional<gpu::Buffer> buffer(std::in_place, std::vector<std::byte>(256));
    std::optional<gpu::Framebuffer> target(std::in_place, gpu::FramebufferDesc{});
    std::optional<gpu::Program> program = build_full_screen(kShowsTheTexture);
    std::optional<gpu::FullScreenTriangle> triangle(std::in_place);
    texture->bind(0);
    buffer->bind_uniform(3);
    buffer->bind_storage(4);
    triangle->draw(*program, *target);
    const auto value_is_bound = [](Slot slot, unsigned index, const gpu::BoundState::Value& value) {
        return !gpu::bound_state().changes(slot, index, value);
    };
    const auto all_bound = [&, t = texture->id(), b = buffer->id(), f = target->id(), p = program->id()] {
        return std::array{value_is_bound(Slot::Texture, 0, {t}), value_is_bound(Slot::UniformBuffer, 3, {b, 0, 256}),
                          value_is_bound(Slot::StorageBuffer, 4, {b, 0, 256}),
                          value_is_bound(Slot::Framebuffer, 0, {f}), value_is_bound(Slot::Program, 0, {p})};
    };
    EXPECT_EQ(all_bound(), (std::array{true, true, true, true, true}));
    texture.reset();
    buffer.reset();
    target.reset();
    program.reset();
    EXPECT_EQ(all_bound(), (std::array{false, false, false, false, false}));
    gpu::forget_bound_state();
}

TEST_F(BoundStateTest, AnotherContextKnowsNothingOfIt) {
    const gpu::Texture texture = texel(5.0F);
    texture.bind(0);
    program_.set("factor", 1.0F);
    EXPECT_EQ(shown(), 5.0F);
    {
        platform::HeadlessContext other({.debug = true});
        gpu::enable_debug_output(true);
        const gpu::Program program = build_full_screen(kShowsTheTexture);
        program.set("factor", 2.0F);
        const gpu::Texture its_own = texel(3.0F);
        its_own.bind(0);
        const gpu::Framebuffer target({.colours = {gpu::Format::RGBA32F}});
        gpu::FullScreenTriangle().draw(program, target);
        EXPECT_EQ(target.read_rgba_float()[0].r, 6.0F);
    }
    context_.make_current();
    EXPECT_EQ(shown(), 5.0F);
}

GLint value_of(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

void expect_in_openGL(const PipelineState& state) {
    EXPECT_EQ(glIsEnabled(GL_DEPTH_TEST) == GL_TRUE, state.depth_test != gpu::DepthTest::Off || state.depth_write);
    EXPECT_EQ(value_of(GL_DEPTH_WRITEMASK) != 0, state.depth_write);
    constexpr std::array depth{GL_ALWAYS, GL_LESS, GL_LEQUAL, GL_EQUAL};
    EXPECT_EQ(value_of(GL_DEPTH_FUNC), depth.at(static_cast<std::size_t>(state.depth_test)));
    EXPECT_EQ(glIsEnabled(GL_CULL_FACE) == GL_TRUE, state.cull != gpu::Cull::None);
    if (state.cull != gpu::Cull::None) {
        EXPECT_EQ(value_of(GL_CULL_FACE_MODE), state.cull == gpu::Cull::Front ? GL_FRONT : GL_BACK);
    }
    EXPECT_EQ(value_of(GL_FRONT_FACE), state.front == gpu::FrontFace::Clockwise ? GL_CW : GL_CCW);
    EXPECT_EQ(glIsEnabled(GL_BLEND) == GL_TRUE, state.blend != gpu::Blend::Off);
    constexpr std::array sources{GL_ONE, GL_ONE, GL_SRC_ALPHA, GL_SRC_ALPHA, GL_ONE, GL_ONE};
    if (state.blend != gpu::Blend::Off) {
        EXPECT_EQ(value_of(GL_BLEND_SRC_RGB), sources.at(static_cast<std::size_t>(state.blend)));
    }
    GLfloat slope = 0.0F;
    glGetFloatv(GL_POLYGON_OFFSET_FACTOR, &slope);
    EXPECT_EQ(glIsEnabled(GL_POLYGON_OFFSET_FILL) == GL_TRUE, state.slope_bias != 0.0F);
    if (state.slope_bias != 0.0F) {
        EXPECT_EQ(slope, state.slope_bias);
    }
    EXPECT_EQ(glIsEnabled(GL_SCISSOR_TEST) == GL_TRUE, state.scissor.has_value());
    std::array<GLint, 4> box{};
    glGetIntegerv(GL_SCISSOR_BOX, box.data());
    if (state.scissor) {
        EXPECT_EQ(box, (std::array{state.scissor->x, state.scissor->y, state.scissor->width, state.scissor->height}));
    }
}

TEST_F(BoundStateTest, AnyOrderOfStatesLeavesTheLastInOpenGL) {
    std::mt19937 random(7);
    const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    for (int i = 0; i < 300; ++i) {
        PipelineState state{.depth_test = static_cast<gpu::DepthTest>(pick(4)),
                            .depth_write = pick(2) == 1,
                            .cull = static_cast<gpu::Cull>(pick(3)),
                            .blend = static_cast<gpu::Blend>(pick(6)),
                            .front = static_cast<gpu::FrontFace>(pick(2)),
                            .slope_bias = static_cast<float>(pick(3))};
        if (pick(2) == 1) state.scissor = gpu::Scissor{.x = pick(3), .y = pick(3), .width = 1 + pick(2), .height = 1};
        if (pick(4) == 0) gpu::set_depth_write(pick(2) == 1);
        gpu::apply(state);
        expect_in_openGL(state);
    }
}

}  // namespace

}  // namespace rowland
