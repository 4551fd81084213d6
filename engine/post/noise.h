#pragma once

#include <cstdint>
#include <optional>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"

namespace rowland::post {

/// Noise of at most half a quantisation step, against bands in slow gradients. It is uniform in the open interval of ±½
/// step, so that the mean of the rounded values is the value; 0 and 1 round to themselves. It is the fractional part of
/// an additive recurrence over pixels with the 2D golden ratio (Roberts 2018, "The unreasonable effectiveness of
/// quasirandom sequences"), which fills small areas as evenly as blue noise; frames advance by the golden ratio.
struct DitherSettings {
    int bits = 8;  ///< of a channel of the target, 1 to 12
};

/// Film grain of mean 0, different in each frame, a pixel and a half wide. At a display value of mean y over the
/// channels its standard deviation is strength · 2√(y (1 − y)), so that black and white have none.
struct GrainSettings {
    float strength = 0.015F;  ///< 0 to 0.5
};

/// The last pass: adds noise to display values, the same in all channels so that greys stay grey. Its random numbers
/// depend on pixel and frame alone and are the same on every machine.
class NoisePass {
 public:
    /// `library` must hold post::shader_files().
    explicit NoisePass(const gpu::ShaderLibrary& library);

    /// Writes display values with noise; alpha is kept. The source must hold more bits than the target: RGBA16 or
    /// RGBA32F. The target must not be larger than the source.
    void draw(const gpu::Texture& source, std::uint32_t frame, const std::optional<DitherSettings>& dither,
              const std::optional<GrainSettings>& grain, const gpu::Framebuffer& target) const;

 private:
    gpu::Program program_;
    gpu::FullScreenTriangle triangle_;
};

/// The size of a step: 1 / (2^bits - 1). A logic error if the settings are out of range.
float dither_step(const DitherSettings& settings);

/// A logic error if a setting is out of range.
void require_valid(const GrainSettings& settings);

}  // namespace rowland::post
