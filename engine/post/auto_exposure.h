#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"

namespace rowland::post {

/// Exposure that follows the picture: its log-average luminance is shown as mid-grey (Reinhard et al. 2002, eqs. 1-2).
struct AutoExposureSettings {
    float key = 0.18F;      ///< key value: scene-linear luminance the average is exposed to; above 0
    float darkest = 1e-4F;  ///< lower bound of a pixel's luminance, so that black does not dominate; above 0
    float min_stops = -8.0F;
    float max_stops = 8.0F;  ///< at least min_stops
    /// Adaptation rates of the stops, 1/s, when they rise (the picture got darker) and when they fall: the distance to
    /// the target shrinks as exp(-speed·t).
    float speed_up = 1.5F;
    float speed_down = 4.0F;
};

/// A picture's mean of log2(max(luminance, darkest)), luminance = weights · pixel, over the pixels where that is
/// finite, to 1e-3; nullopt if there are none.
using MeanLog2Luminance = std::optional<double>;

/// Measures pictures on the GPU: each pass sums blocks of 8×8 texels, down to one. The results are read when the GPU
/// has finished, a frame or two later.
class AutoExposurePass {
 public:
    /// `library` must hold post::shader_files().
    explicit AutoExposurePass(const gpu::ShaderLibrary& library);

    /// Starts a measurement. `weights` is the Y row of the working space's matrix to XYZ. Waits only if the GPU is more
    /// than two measurements late.
    void start(const gpu::Texture& picture, const glm::vec3& weights, float darkest);
    /// The newest finished result not returned yet, perhaps a null one; nullopt: none is finished. Does not wait.
    std::optional<MeanLog2Luminance> take();
    /// The result of the last measurement started, which must not have been returned yet (checked). Waits for the GPU.
    MeanLog2Luminance wait();

    /// Passes of the last measurement: 4 for 1920×1080.
    int passes() const { return static_cast<int>(sums_.size()); }

 private:
    static constexpr std::size_t kMaxInFlight = 3;  ///< measurements on the GPU

    void make_sums(glm::ivec2 size);
    void sum(const gpu::Program& program, const gpu::Texture& source, std::size_t pass);
    /// Index of the measurement started `age` before the last one, and its result, once the GPU has finished it.
    std::size_t index_of(std::size_t age) const;
    MeanLog2Luminance read(std::size_t age);

    gpu::Program sum_picture_;
    gpu::Program sum_sums_;
    gpu::FullScreenTriangle triangle_;
    std::vector<gpu::Framebuffer> sums_;  ///< sum of logarithms in red, count in green; the last is one texel
    glm::ivec2 size_{0};
    gpu::Buffer totals_;  ///< of each measurement, as the last of sums_; at multiples of kBufferAlignment
    std::array<std::optional<gpu::Fence>, kMaxInFlight> finished_;  ///< null: not in flight
    std::size_t last_ = 0;                                          ///< index of the last measurement started
};

/// log2(key) - mean_log2, clamped to [min_stops, max_stops].
float target_stops(double mean_log2, const AutoExposureSettings& settings);

/// The stops that `stops` have adapted to after `seconds` (at least 0) on their way to the target. Steps compose: the
/// number of frames that the time passes in makes no difference.
float adapted_stops(float stops, float target, float seconds, const AutoExposureSettings& settings);

/// A logic error if a setting is out of range.
void require_valid(const AutoExposureSettings& settings);

}  // namespace rowland::post
