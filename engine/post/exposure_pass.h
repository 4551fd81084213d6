#pragma once

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/full_screen_pass.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"

namespace rowland::post {

/// Manual exposure as a pass of its own, for effects between exposure and display. Where there are none, DisplayPass
/// exposes at no extra cost.
class ExposurePass {
 public:
    /// `library` must hold post::shader_files().
    explicit ExposurePass(const gpu::ShaderLibrary& library);

    /// Writes source · 2^stops, pixel by pixel; alpha is kept. The target must not be larger than the source.
    void draw(const gpu::Texture& source, float stops, const gpu::Framebuffer& target) const;

 private:
    gpu::Program program_;
    gpu::FullScreenTriangle triangle_;
};

}  // namespace rowland::post
