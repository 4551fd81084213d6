#include "engine/gpu/full_screen_pass.h"

#include "engine/gpu/pipeline_state.h"

namespace rowland::gpu {

void FullScreenTriangle::draw(const Program& program, const Framebuffer& target) const {
    target.bind();
    draw(program);
}

void FullScreenTriangle::draw(const Program& program) const {
    apply(PipelineState{.depth_test = DepthTest::Off, .depth_write = false, .cull = Cull::None, .blend = Blend::Off});
    program.use();
    vertices_.draw(3);
}

}  // namespace rowland::gpu
