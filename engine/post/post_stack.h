#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "engine/core/text.h"
#include "engine/gpu/framebuffer.h"
#include "engine/gpu/pass_times.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"
#include "engine/post/auto_exposure.h"
#include "engine/post/bloom.h"
#include "engine/post/depth_of_field.h"
#include "engine/post/display_pass.h"
#include "engine/post/glare.h"
#include "engine/post/noise.h"
#include "engine/post/vignette.h"

namespace rowland::post {

/// The shaders of the post effects, for gpu::ShaderLibrary::add_embedded.
std::span<const EmbeddedFile> shader_files();

/// The effects; by default none but the display transform.
struct PostSettings {
    std::optional<DepthOfFieldSettings> depth_of_field = {};
    std::optional<GlareSettings> glare = {};
    std::optional<BloomSettings> bloom = {};
    std::optional<AutoExposureSettings> auto_exposure = {};
    /// If true, automatic exposure measures the frame that it exposes, and each frame waits for the GPU. Otherwise it
    /// uses the luminance of one or two frames before, and only the first frame waits.
    bool wait_for_exposure = false;
    float exposure_stops = 0.0F;  ///< added to the automatic exposure, if that is on
    std::optional<VignetteSettings> vignette = {};
    /// Grain and dither clamp values to 0 … 1; turn both off for comparisons.
    std::optional<GrainSettings> grain = {};
    std::optional<DitherSettings> dither = {};
};

struct PostFrame {
    std::uint32_t index = 0;              ///< of the frame, for grain and dither
    float seconds = 0.0F;                 ///< since the last frame, for automatic exposure
    glm::vec3 luminance_weights{0.0F};    ///< post::luminance_weights, for automatic exposure
    const gpu::Texture* depth = nullptr;  ///< of the picture, for the depth of field
    LensView lens = {};                   ///< likewise
};

/// From a scene-linear picture to a display: depth of field, glare, bloom, exposure, vignette, display transform, grain
/// and dither, in this order. An effect that is off, or set so that it changes nothing, runs no pass and compiles no
/// program.
class PostStack {
 public:
    /// `library` must hold post::shader_files() and outlive the stack.
    explicit PostStack(const gpu::ShaderLibrary& library) : library_(&library) {}

    /// Draws the scene-linear `hdr` (RGBA16F or RGBA32F, finite or not) as `display` shows it; alpha is kept. The
    /// target must not be larger than `hdr`. It is a logic error if settings are out of range, or if automatic exposure
    /// is on and the frame has no luminance weights, or depth of field and no depth. Nothing waits for the GPU but
    /// automatic exposure, in the first frame that it is on, after forget_exposure(), and where the settings say so.
    void draw(const gpu::Texture& hdr, const DisplayPass& display, const PostSettings& settings, const PostFrame& frame,
              const gpu::Framebuffer& target);

    /// Passes of the last draw: 1 with all effects off, that of the display.
    int passes() const { return passes_; }
    /// The stops the last draw exposed by, manual and automatic together.
    float exposure_stops() const { return exposure_stops_; }
    /// Makes the next frame start at its own automatic exposure, as the first does: for cuts.
    void forget_exposure() { automatic_stops_ = target_stops_ = std::nullopt; }
    /// Rebuilds the programs in use from `library`, which replaces the present one. If one does not compile, all stay
    /// as they were and its Error (system) is thrown.
    void reload(const gpu::ShaderLibrary& library);
    /// Times each effect that runs, by the names "depth of field", "glare", "bloom", "auto exposure", "vignette",
    /// "display" and "noise". Null, the default: nothing is timed. `times` must outlive the draws.
    void set_pass_times(gpu::PassTimes* times) { times_ = times; }

 private:
    const gpu::Texture& with_depth_of_field(const gpu::Texture& picture, const PostSettings& settings,
                                            const PostFrame& frame);
    const gpu::Texture& with_glare(const gpu::Texture& picture, const PostSettings& settings);
    const gpu::Texture& with_bloom(const gpu::Texture& picture, const PostSettings& settings);
    const gpu::Texture& with_vignette(const gpu::Texture& picture, const PostSettings& settings);
    float automatic_stops(const gpu::Texture& picture, const PostSettings& settings, const PostFrame& frame);
    void draw_display(const gpu::Texture& picture, const DisplayPass& display, const PostSettings& settings,
                      const PostFrame& frame, const gpu::Framebuffer& target);

    const gpu::ShaderLibrary* library_;
    gpu::PassTimes* times_ = nullptr;
    std::optional<DepthOfFieldPass> depth_of_field_;
    std::optional<GlarePass> glare_;
    std::optional<BloomPass> bloom_;
    std::optional<AutoExposurePass> auto_exposure_;
    std::optional<VignettePass> vignette_;
    std::optional<NoisePass> noise_;
    std::optional<gpu::Framebuffer> focused_;
    std::optional<gpu::Framebuffer> glared_;
    std::optional<gpu::Framebuffer> bloomed_;
    std::optional<gpu::Framebuffer> vignetted_;
    std::optional<gpu::Framebuffer> displayed_;
    std::optional<float> target_stops_;  ///< null: the picture has no luminance
    std::optional<float> automatic_stops_;
    float exposure_stops_ = 0.0F;
    int passes_ = 0;
};

}  // namespace rowland::post
