#pragma once

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/full_screen_pass.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"
#include "engine/post/dither.h"

namespace rowland::post {

/// apply_dither on the GPU, as the last pass.
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

}  // namespace rowland::post
