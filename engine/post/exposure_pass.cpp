#include "engine/post/exposure_pass.h"

#include "engine/post/exposure.h"

namespace rowland::post {

ExposurePass::ExposurePass(const gpu::ShaderLibrary& library)
    : program_(library,
               {.vertex = gpu::full_screen_vertex_shader, .fragment = "engine/post/shaders/exposure.frag.glsl"}) {}

void ExposurePass::draw(const gpu::Texture& source, float stops, const gpu::Framebuffer& target) const {
    program_.set("scale", exposure_scale(stops));
    source.bind(0);
    triangle_.draw(program_, target);
}

}  // namespace rowland::post
