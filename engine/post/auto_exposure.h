#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/full_screen_pass.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"

namespace rowland::post {

/// Exposure that follows the picture: its log-average luminance is shown as mid-grey (Reinhard et al. 2002, eqs. 1-2).
struct AutoExposureSettings {
    float key = 0.18F;      ///< scene-linear luminance the average is exposed to; above 0
    float darkest = 1e-4F;  ///< lower bound of a pixel's luminance, so that black does not dominate; above 0
    float min_stops = -8.0F;
    float max_stops = 8.0F;  ///< at least min_stops
    /// How fast stops rise (the eye adapts to the dark) and fall, 1/s: the distance to the target shrinks as
    /// exp(-speed·t).
    float speed_up = 1.5F;
    float speed_down = 4.0F;
};

/// Measures a picture on the GPU: each pass sums blocks of 8×8 texels, down to one.
class AutoExposurePass {
 public:
    /// `library` must hold post::shader_files().
    explicit AutoExposurePass(const gpu::ShaderLibrary& library);

    /// The mean of log2(max(luminance, darkest)), luminance = weights · pixel, over the pixels where that is finite;
    /// null if there are none. To 1e-3. `weights` is the Y row of the working space's matrix to XYZ. Waits for the GPU:
    /// the result is of this very picture.
    std::optional<double> measure(const gpu::Texture& picture, const glm::vec3& weights, float darkest);

    /// Passes of the last measurement: 4 for 1920×1080.
    int passes() const { return static_cast<int>(sums_.size()); }

 private:
    void make_sums(glm::ivec2 size);

    gpu::Program sum_picture_;
    gpu::Program sum_sums_;
    gpu::FullScreenTriangle triangle_;
    std::vector<gpu::Framebuffer> sums_;  ///< sum of logarithms in red, count in green; the last is one texel
    glm::ivec2 size_{0};
};

/// log2(key) - mean_log2, clamped to [min_stops, max_stops].
float target_stops(double mean_log2, const AutoExposureSettings& settings);

/// The stops that `stops` have adapted to after `seconds` (at least 0) on their way to the target. Steps compose: the
/// number of frames that the time passes in makes no difference.
float adapted_stops(float stops, float target, float seconds, const AutoExposureSettings& settings);

/// A logic error if a setting is out of range.
void require_valid(const AutoExposureSettings& settings);

}  // namespace rowland::post
