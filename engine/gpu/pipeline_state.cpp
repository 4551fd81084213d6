#include "engine/gpu/pipeline_state.h"

#include <epoxy/gl.h>
#include <array>
#include <bit>
#include <cstddef>

namespace rowland::gpu {

bool BoundState::changes(Slot slot, unsigned index, const Value& value) {
    const auto [known, is_new] = values_.try_emplace({slot, index}, value);
    if (!is_new && known->second == value) return false;
    known->second = value;
    return true;
}

void BoundState::forget(Slot slot, GLuint name) {
    std::erase_if(values_, [&](const auto& known) { return known.first.first == slot && known.second[0] == name; });
}

BoundState& bound_state() {
    thread_local BoundState state;
    return state;
}

void forget_bound_state() {
    bound_state().forget_all();
}

namespace {

using Slot = BoundState::Slot;

void set_enabled(GLenum capability, bool enabled) {
    if (!bound_state().changes(Slot::Capability, capability, {enabled})) return;
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
constexpr std::array<BlendFactors, 6> kBlendFactors = {{{GL_ONE, GL_ZERO, GL_ONE},
                                                        {GL_ONE, GL_ONE, GL_ZERO},
                                                        {GL_SRC_ALPHA, GL_ONE, GL_ZERO},
                                                        {GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE},
                                                        {GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE},
                                                        {GL_ONE, GL_SRC1_COLOR, GL_ONE}}};
constexpr std::array<GLenum, 4> kDepthFunctions = {GL_ALWAYS, GL_LESS, GL_LEQUAL, GL_EQUAL};

void apply_depth(const PipelineState& state) {
    // With the test disabled GL would not write depth either.
    set_enabled(GL_DEPTH_TEST, state.depth_test != DepthTest::Off || state.depth_write);
    set_depth_write(state.depth_write);
    const GLenum function = kDepthFunctions.at(static_cast<std::size_t>(state.depth_test));
    if (bound_state().changes(Slot::DepthFunction, 0, {function})) glDepthFunc(function);
    set_enabled(GL_POLYGON_OFFSET_FILL, state.slope_bias != 0.0F);
    if (state.slope_bias == 0.0F) return;
    if (bound_state().changes(Slot::SlopeBias, 0, {std::bit_cast<std::int32_t>(state.slope_bias)}))
        glPolygonOffset(state.slope_bias, 0.0F);
}

void apply_faces(const PipelineState& state) {
    set_enabled(GL_CULL_FACE, state.cull != Cull::None);
    const GLenum front = state.front == FrontFace::Clockwise ? GL_CW : GL_CCW;
    if (bound_state().changes(Slot::FrontFace, 0, {front})) glFrontFace(front);
    if (state.cull == Cull::None) return;
    const GLenum culled = state.cull == Cull::Front ? GL_FRONT : GL_BACK;
    if (bound_state().changes(Slot::CulledFace, 0, {culled})) glCullFace(culled);
}

void apply_blending(const PipelineState& state) {
    set_enabled(GL_BLEND, state.blend != Blend::Off);
    if (state.blend == Blend::Off) return;
    const auto& [source, target, source_alpha] = kBlendFactors.at(static_cast<std::size_t>(state.blend));
    if (bound_state().changes(Slot::BlendFactors, 0, {source, target, source_alpha}))
        glBlendFuncSeparate(source, target, source_alpha, target);
}

void apply_scissor(const PipelineState& state) {
    set_enabled(GL_SCISSOR_TEST, state.scissor.has_value());
    if (!state.scissor) return;
    const auto& [x, y, width, height] = *state.scissor;
    if (bound_state().changes(Slot::Scissor, 0, {x, y, width, height})) glScissor(x, y, width, height);
}

}  // namespace

void set_depth_write(bool on) {
    if (bound_state().changes(Slot::DepthWrite, 0, {on})) glDepthMask(on ? GL_TRUE : GL_FALSE);
}

void apply(const PipelineState& state) {
    apply_depth(state);
    apply_faces(state);
    apply_blending(state);
    apply_scissor(state);
    if (bound_state().changes(Slot::ColourMask, 0, {})) glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    set_enabled(GL_STENCIL_TEST, false);
    set_enabled(GL_FRAMEBUFFER_SRGB, false);
}

}  // namespace rowland::gpu
