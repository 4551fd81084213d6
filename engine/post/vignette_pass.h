#pragma once

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/full_screen_pass.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"
#include "engine/post/vignette.h"

namespace rowland::post {

/// apply_vignette on the GPU.
class VignettePass {
 public:
    /// `library` must hold post::shader_files().
    explicit VignettePass(const gpu::ShaderLibrary& library);

    /// Writes source · vignette_factor; alpha is kept. Source and target have the same size, else it is a logic error.
    void draw(const gpu::Texture& source, const VignetteSettings& settings, const gpu::Framebuffer& target) const;

 private:
    gpu::Program program_;
    gpu::FullScreenTriangle triangle_;
};

}  // namespace rowland::post
