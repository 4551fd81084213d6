#include "editor/inspector/groove_overlay.h"

#include <glm/matrix.hpp>
#include <span>

#include "editor/inspector/overlay_shaders.h"
#include "engine/gpu/pipeline_state.h"
#include "engine/gpu/shader_library.h"

namespace rowland::inspector {

namespace {

constexpr float kCell = 16.0F;       ///< pixels between strokes
constexpr float kStep = 1e-4F;       ///< metres; small against an object of 0.1 m
constexpr bool kEvenMoments = true;  ///< grooves have no sense of direction

gpu::Program overlay_program() {
    gpu::ShaderLibrary library;
    library.add_embedded(overlay_shaders());
    return {library,
            {.vertex = "editor/inspector/groove_overlay.vert.glsl",
             .fragment = "editor/inspector/groove_overlay.frag.glsl"}};
}

}  // namespace

GrooveOverlay::GrooveOverlay() : program_(overlay_program()) {}

void GrooveOverlay::begin(glm::ivec2 size, const glm::mat4& world_to_clip) {
    if (!target_ || target_->size() != size)
        target_.emplace(
            gpu::FramebufferDesc{.width = size.x, .height = size.y, .colours = {gpu::Format::RGBA8}, .depth = true});
    target_->bind();
    gpu::apply({.depth_test = gpu::DepthTest::Less, .depth_write = true, .cull = gpu::Cull::None});
    target_->clear(glm::vec4(0.0F));
    target_->clear_depth();
    program_.use();
    program_.set("world_to_clip", world_to_clip);
    program_.set("size", glm::vec2(size));
    program_.set("cell", kCell);
    program_.set("step_length", kStep);
}

void GrooveOverlay::draw(const render::GpuMesh& mesh, const glm::mat4& object_to_world, const CookedGrating* grating) {
    const glm::mat3 linear(object_to_world);
    const float determinant = glm::determinant(linear);
    if (determinant == 0.0F) return;
    program_.set("object_to_world", object_to_world);
    program_.set("normal_to_world", glm::transpose(glm::inverse(linear)));
    program_.set("mirroring", determinant < 0.0F ? -1.0F : 1.0F);
    program_.set("chosen", grating != nullptr ? 1 : 0);
    if (grating != nullptr) {
        program_.set("groove_rotation", static_cast<float>(grating->groove_rotation));
        program_.set("mapped", grating->grooves ? 1 : 0);
        if (grating->grooves) {
            program_.set("uv_set", grating->grooves->uv_set());
            grating->grooves->bind(kEvenMoments, program_);
        }
    }
    mesh.draw();
}

}  // namespace rowland::inspector
