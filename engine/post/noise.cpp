#include "engine/post/noise.h"

#include "engine/core/check.h"

namespace rowland::post {

NoisePass::NoisePass(const gpu::ShaderLibrary& library)
    : program_(library, gpu::full_screen_pass("engine/post/shaders/noise.frag.glsl")) {}

void NoisePass::draw(const gpu::Texture& source, std::uint32_t frame, const std::optional<DitherSettings>& dither,
                     const std::optional<GrainSettings>& grain, const gpu::Framebuffer& target) const {
    if (grain) require_valid(*grain);
    program_.set("frame", static_cast<int>(frame));
    program_.set("step_size", dither ? dither_step(*dither) : 0.0F);
    program_.set("grain", grain ? grain->strength : 0.0F);
    source.bind(0);
    triangle_.draw(program_, target);
}

float dither_step(const DitherSettings& settings) {
    ROWLAND_CHECK_OP(settings.bits, >=, 1);
    ROWLAND_CHECK_OP(settings.bits, <=, 12);
    return 1.0F / static_cast<float>((1 << settings.bits) - 1);
}

void require_valid(const GrainSettings& settings) {
    ROWLAND_CHECK_OP(settings.strength, >=, 0.0F);
    ROWLAND_CHECK_OP(settings.strength, <=, 0.5F);
}

}  // namespace rowland::post
