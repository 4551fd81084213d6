#pragma once

#include <cstdint>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/full_screen_pass.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"

namespace rowland::post {

/// Noise below one step of the screen, so that slow gradients show no bands.
struct DitherSettings {
    int bits = 8;  ///< of a channel of the target, 1 to 12
};

/// The last pass: adds noise to display values, the same in all channels so that greys stay grey. It is evenly
/// distributed between -½ and ½ (never either) steps of the target, so that the mean of rounded values is the value,
/// and the same for the same pixel and frame on every machine: the fractional parts of an additive lattice of pixels,
/// with the 2D golden ratio (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"), which fills
/// small areas as evenly as blue noise; frames advance by the golden ratio. 0 and 1 stay as they are.
class DitherPass {
 public:
    /// `library` must hold post::shader_files().
    explicit DitherPass(const gpu::ShaderLibrary& library);

    /// Writes display values with noise; alpha is kept. The source must be finer than the target: RGBA16 or RGBA32F.
    /// The target must not be larger than the source.
    void draw(const gpu::Texture& source, std::uint32_t frame, const DitherSettings& settings,
              const gpu::Framebuffer& target) const;

 private:
    gpu::Program program_;
    gpu::FullScreenTriangle triangle_;
};

/// The size of a step: 1 / (2^bits - 1). A logic error if the settings are out of range.
float dither_step(const DitherSettings& settings);

}  // namespace rowland::post
