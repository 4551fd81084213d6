#include "engine/gpu/pipeline_state.h"

#include <epoxy/gl.h>

namespace rowland::gpu {

namespace {

void set_enabled(GLenum capability, bool enabled) {
    if (enabled) {
        glEnable(capability);
    } else {
        glDisable(capability);
    }
}

void apply_blend(Blend blend) {
    set_enabled(GL_BLEND, blend != Blend::Off);
    switch (blend) {
        case Blend::Off:
            return;
        case Blend::Add:
            glBlendFunc(GL_ONE, GL_ONE);
            return;
        case Blend::Over:
            glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
            return;
        case Blend::Premultiplied:
            glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
            return;
    }
}

void apply_depth(DepthTest test, bool write) {
    // With the test disabled GL would not write depth either.
    set_enabled(GL_DEPTH_TEST, test != DepthTest::Off || write);
    glDepthMask(write ? GL_TRUE : GL_FALSE);
    switch (test) {
        case DepthTest::Off:
            glDepthFunc(GL_ALWAYS);
            return;
        case DepthTest::Less:
            glDepthFunc(GL_LESS);
            return;
        case DepthTest::LessEqual:
            glDepthFunc(GL_LEQUAL);
            return;
        case DepthTest::Equal:
            glDepthFunc(GL_EQUAL);
            return;
    }
}

}  // namespace

void apply(const PipelineState& state) {
    apply_depth(state.depth_test, state.depth_write);
    set_enabled(GL_CULL_FACE, state.cull != Cull::None);
    glFrontFace(state.front == FrontFace::Clockwise ? GL_CW : GL_CCW);
    glCullFace(state.cull == Cull::Front ? GL_FRONT : GL_BACK);
    apply_blend(state.blend);
    set_enabled(GL_POLYGON_OFFSET_FILL, state.slope_bias != 0.0F);
    if (state.slope_bias != 0.0F) glPolygonOffset(state.slope_bias, 0.0F);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    set_enabled(GL_SCISSOR_TEST, state.scissor.has_value());
    if (state.scissor) glScissor(state.scissor->x, state.scissor->y, state.scissor->width, state.scissor->height);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
}

}  // namespace rowland::gpu
