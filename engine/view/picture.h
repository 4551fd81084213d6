#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/gpu/framebuffer.h"
#include "engine/gpu/pass_times.h"
#include "engine/gpu/shader_library.h"
#include "engine/lighting/light_probe.h"
#include "engine/post/display_pass.h"
#include "engine/post/ocio_config.h"
#include "engine/post/post_stack.h"
#include "engine/render/renderer.h"
#include "engine/scene/camera.h"

namespace rowland::view {

/// `path` with the frame's number before the extension if there is more than one frame.
std::filesystem::path numbered(const std::filesystem::path& path, int frame, int frames);

/// Writes a display-encoded framebuffer as PNG and logs the path. Throws Error (system) if the context is lost or the
/// file cannot be written.
void write_display_capture(const gpu::Framebuffer& display, const std::filesystem::path& path);

/// Writes a scene-linear framebuffer as OpenEXR and logs the path. Throws Error (system) if a pixel is not finite, the
/// context is lost or the file cannot be written.
void write_linear_capture(const gpu::Framebuffer& linear, const std::filesystem::path& path);

/// From a world to display values: the renderer with four samples per pixel, and the post stack. The same with and
/// without a window. Modules register with `renderer()`.
class Picture {
 public:
    /// `view`: one of the display's; empty for its default. Throws Error (input) if the display has no such view.
    Picture(const post::OcioConfig& config, const std::string& view, glm::ivec2 size);

    const glm::dmat3& xyz_to_working() const { return xyz_to_working_; }
    /// Counts as a cut: automatic exposure starts again, as in the first frame.
    void set_probe(const lighting::LightProbe& probe);
    /// Throws Error (input) if the display has no such view.
    void set_view(const post::OcioConfig& config, const std::string& view);
    void resize(glm::ivec2 size);
    /// Rebuilds all shaders in use from a source tree; throws Error and keeps the old ones if one does not compile.
    void reload_shaders(const std::filesystem::path& source_tree);
    /// The paths of the shaders in use below a source tree.
    std::vector<std::filesystem::path> shader_sources(const std::filesystem::path& source_tree) const;
    render::Renderer& renderer() { return renderer_; }

    /// Draws a frame, `seconds` after the last. Throws Error (system) if the context is lost.
    void draw(ecs::World& world, const scene::Camera& camera, float seconds);

    /// Whether pass_times() are taken; off by default.
    void time_passes(bool on);
    const gpu::PassTimes& pass_times() const { return pass_times_; }
    post::PostSettings& post_settings() { return post_settings_; }
    /// Exposure of the last frame in stops, manual and automatic together.
    float exposure_stops() const { return post_stack_.exposure_stops(); }
    /// Scene-linear working RGB.
    const gpu::Framebuffer& linear() const { return targets_->linear; }
    /// Display values, 8 bits.
    const gpu::Framebuffer& encoded() const { return targets_->encoded; }

 private:
    const gpu::Texture* resolved_depth();

    struct Targets {
        gpu::Framebuffer multisampled;
        gpu::Framebuffer linear;
        gpu::Framebuffer encoded;
        std::optional<gpu::Framebuffer> depth = std::nullopt;  ///< one sample per pixel, for depth of field
    };

    glm::dmat3 xyz_to_working_;
    glm::vec3 luminance_weights_;
    render::Renderer renderer_;
    gpu::PassTimes pass_times_;
    bool timed_ = false;
    std::unique_ptr<gpu::ShaderLibrary> post_shaders_;
    post::DisplayTransform transform_;
    post::DisplayPass display_;
    post::PostStack post_stack_;
    post::PostSettings post_settings_;
    std::optional<Targets> targets_;
    std::uint32_t frame_ = 0;
};

}  // namespace rowland::view
