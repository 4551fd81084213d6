#include "engine/post/vignette_pass.h"

#include <cmath>

#include "engine/core/check.h"

namespace rowland::post {

VignettePass::VignettePass(const gpu::ShaderLibrary& library)
    : program_(library,
               {.vertex = gpu::full_screen_vertex_shader, .fragment = "engine/post/shaders/vignette.frag.glsl"}) {}

void VignettePass::draw(const gpu::Texture& source, const VignetteSettings& settings,
                        const gpu::Framebuffer& target) const {
    require_valid(settings);
    ROWLAND_CHECK(source.size() == target.size(), "the target of a vignette must have the source's size");
    program_.set("tan_half_fov", settings.vertical_fov ? std::tan(0.5F * *settings.vertical_fov) : 0.0F);
    program_.set("strength", settings.strength);
    program_.set("radius", settings.radius);
    program_.set("softness", settings.softness);
    source.bind(0);
    triangle_.draw(program_, target);
}

}  // namespace rowland::post
