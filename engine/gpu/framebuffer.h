#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <utility>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"

namespace rowland::gpu {

struct FramebufferDesc {
    int width = 1;
    int height = 1;
    std::vector<Format> colours{
        Format::RGBA16F};          ///< one texture each, `layout(location = i) out` in GLSL; may be none
    bool depth = false;            ///< adds a Depth32F texture
    int samples = 1;               ///< above 1: drawn into only, and read through resolve_to()
    Sampling depth_sampling = {};  ///< of the depth texture
};

/// Textures to draw into.
class Framebuffer {
 public:
    Framebuffer() = default;
    /// Makes its own textures (linear filter, clamped). Throws Error (system) if the driver refuses the combination.
    explicit Framebuffer(const FramebufferDesc& desc);
    /// Draws into one level and layer (slice, face) of a texture, which must outlive it.
    static Framebuffer onto(const Texture& texture, int level = 0, int layer = 0);

    /// Averages the samples of every pixel into the colours of `target`, of the same size and formats. Depth is not
    /// copied.
    void resolve_to(const Framebuffer& target) const;

    /// Copies one sample of every pixel's depth to `target`, of the same size.
    void resolve_depth_to(const Framebuffer& target) const;

    /// Copies the first colour into the window's own framebuffer, pixel by pixel from the lower left.
    void show_in_window() const;

    /// Draws go here from now on, with a viewport over the whole area.
    void bind() const;
    /// Draws go to the window's own framebuffer from now on. The viewport stays as it is.
    static void bind_window();
    void clear(const glm::vec4& colour, unsigned attachment = 0) const;
    void clear_depth(float depth = 1.0F) const;

    /// The textures that it made itself; it is a logic error to ask for one that it has not made, as with several
    /// samples.
    const Texture& colour(unsigned attachment = 0) const;
    const Texture& depth() const;

    /// Pixels, rows from the top of the picture down, as images and files have them. Waits for the GPU.
    std::vector<glm::vec4> read_rgba_float(unsigned attachment = 0) const;
    /// The same as 8-bit RGBA bytes, clamped to [0, 1] first.
    std::vector<std::uint8_t> read_rgba8(unsigned attachment = 0) const;

    /// Whether the first colour holds half floats, which a shader rounds to (dialect.glsl).
    bool holds_halves() const { return holds_halves_; }

    glm::ivec2 size() const { return size_; }
    GLuint id() const { return handle_.get(); }

 private:
    struct Release {
        void operator()(GLuint name) const;
    };
    struct ReleaseRenderbuffer {
        void operator()(GLuint name) const;
    };
    void attach(GLenum attachment, Format format, const FramebufferDesc& desc, std::vector<Texture>& textures);
    void require_complete() const;
    void read(unsigned attachment, GLenum type, void* pixels) const;

    Handle<Release> handle_;
    glm::ivec2 size_{0};
    bool holds_halves_ = false;
    std::vector<Texture> colours_;
    std::vector<Texture> depth_;  ///< one or none
    std::vector<Handle<ReleaseRenderbuffer>> multisampled_;
    std::size_t colour_count_ = 1;
};

/// The vertex stage of a full-screen pass: `layout(location = 0) out vec2 uv`, (0,0) at the lower left.
inline constexpr const char* full_screen_vertex_shader = "engine/gpu/shaders/full_screen_triangle.vert.glsl";

/// The program of a full-screen pass.
inline ProgramDesc full_screen_pass(std::string fragment, std::vector<Define> defines = {}) {
    return {.vertex = full_screen_vertex_shader, .fragment = std::move(fragment), .defines = std::move(defines)};
}

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
