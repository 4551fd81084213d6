#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "editor/inspector/cook_grating.h"
#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/render/gpu_mesh.h"

namespace rowland::inspector {

/// A picture of groove directions, to lay over the picture of the same camera: strokes along the grooves, hidden where
/// something is in front. Needs a current context.
class GrooveOverlay {
 public:
    GrooveOverlay();

    /// Clears the picture.
    void begin(glm::ivec2 size, const glm::mat4& world_to_clip);
    /// Adds a mesh; `grating`: whose grooves are shown, null: it only covers others.
    void draw(const render::GpuMesh& mesh, const glm::mat4& object_to_world, const CookedGrating* grating);

    const gpu::Framebuffer& picture() const { return *target_; }

 private:
    gpu::Program program_;
    std::optional<gpu::Framebuffer> target_;
};

}  // namespace rowland::inspector
