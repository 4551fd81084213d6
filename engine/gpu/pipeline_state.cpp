#include "engine/gpu/pipeline_state.h"

#include <epoxy/gl.h>

#include <array>
#include <cstddef>

namespace rowland::gpu {

namespace {

void set_enabled(GLenum capability, bool enabled) {
    if (enabled) {
        glEnable(capability);
    } else {
        glDisable(capability);
    }
}

struct BlendFactors {
    GLenum source, target;
    GLenum source_alpha;
};
constexpr std::array<BlendFactors, 4> kBlendFactors = {{{GL_ONE, GL_ZERO, GL_ONE},
                                                        {GL_ONE, GL_ONE, GL_ONE},
                                                        {GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE},
                                                        {GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE}}};
constexpr std::array<GLenum, 4> kDepthFunctions = {GL_ALWAYS, GL_LESS, GL_LEQUAL, GL_EQUAL};

}  // namespace

void apply(const PipelineState& state) {
    // With the test disabled GL would not write depth either.
    set_enabled(GL_DEPTH_TEST, state.depth_test != DepthTest::Off || state.depth_write);
    glDepthMask(state.depth_write ? GL_TRUE : GL_FALSE);
    glDepthFunc(kDepthFunctions.at(static_cast<std::size_t>(state.depth_test)));
    set_enabled(GL_CULL_FACE, state.cull != Cull::None);
    glFrontFace(state.front == FrontFace::Clockwise ? GL_CW : GL_CCW);
    glCullFace(state.cull == Cull::Front ? GL_FRONT : GL_BACK);
    set_enabled(GL_BLEND, state.blend != Blend::Off);
    const BlendFactors& factors = kBlendFactors.at(static_cast<std::size_t>(state.blend));
    glBlendFuncSeparate(factors.source, factors.target, factors.source_alpha, factors.target);
    set_enabled(GL_POLYGON_OFFSET_FILL, state.slope_bias != 0.0F);
    if (state.slope_bias != 0.0F) glPolygonOffset(state.slope_bias, 0.0F);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    set_enabled(GL_SCISSOR_TEST, state.scissor.has_value());
    if (state.scissor) glScissor(state.scissor->x, state.scissor->y, state.scissor->width, state.scissor->height);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
}

}  // namespace rowland::gpu
