#include "engine/post/dither.h"

#include "engine/core/check.h"

namespace rowland::post {

DitherPass::DitherPass(const gpu::ShaderLibrary& library)
    : program_(library,
               {.vertex = gpu::full_screen_vertex_shader, .fragment = "engine/post/shaders/dither.frag.glsl"}) {}

void DitherPass::draw(const gpu::Texture& source, std::uint32_t frame, const DitherSettings& settings,
                      const gpu::Framebuffer& target) const {
    program_.set("frame", static_cast<int>(frame));
    program_.set("step_size", dither_step(settings));
    source.bind(0);
    triangle_.draw(program_, target);
}

float dither_step(const DitherSettings& settings) {
    ROWLAND_CHECK_OP(settings.bits, >=, 1);
    ROWLAND_CHECK_OP(settings.bits, <=, 12);
    return 1.0F / static_cast<float>((1 << settings.bits) - 1);
}

}  // namespace rowland::post
