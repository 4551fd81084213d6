#pragma once

#include <string>
#include <vector>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/vertex_array.h"

namespace rowland::gpu {

/// The vertex stage of a full-screen pass: `layout(location = 0) out vec2 uv`, (0,0) at the lower left.
inline constexpr const char* full_screen_vertex_shader = "engine/gpu/shaders/full_screen_triangle.vert.glsl";

/// One triangle that covers the target.
class FullScreenTriangle {
 public:
    /// Runs `program` once for every pixel of `target`: no depth, no blending. Textures and uniforms are set by the
    /// caller.
    void draw(const Program& program, const Framebuffer& target) const;
    /// The same onto the bound framebuffer.
    void draw(const Program& program) const;

 private:
    VertexArray vertices_;
};

}  // namespace rowland::gpu
