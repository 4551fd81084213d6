#pragma once

#include <vector>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/full_screen_pass.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"
#include "engine/post/bloom.h"

namespace rowland::post {

/// apply_bloom on the GPU, in RGBA16F. Rounding between the levels is to nearest whatever the driver does, so that the
/// sum is kept to 1e-3.
class BloomPass {
 public:
    /// `library` must hold post::shader_files().
    explicit BloomPass(const gpu::ShaderLibrary& library);

    /// Writes the picture with bloom; alpha is kept. Source (RGBA16F or RGBA32F) and target have the same size, else it
    /// is a logic error. Makes textures when the size or the number of levels changes.
    void draw(const gpu::Texture& source, const BloomSettings& settings, const gpu::Framebuffer& target);

    /// How many passes the last draw took: two per level.
    int passes() const { return passes_; }

 private:
    void make_levels(glm::ivec2 size, int levels);
    void draw_coarser(const gpu::Program& program, const gpu::Texture& fine, const gpu::Framebuffer& target);
    void mix_in(const gpu::Program& program, const gpu::Texture& fine, const gpu::Texture& coarse, float share,
                const gpu::Framebuffer& target);

    gpu::Program picture_to_coarser_;
    gpu::Program level_to_coarser_;
    gpu::Program mix_into_level_;
    gpu::Program mix_into_picture_;
    gpu::FullScreenTriangle triangle_;
    std::vector<gpu::Framebuffer> down_;  ///< light and area, finest first
    std::vector<gpu::Framebuffer> up_;    ///< the mixes; one fewer, as the coarsest level has nothing to mix in
    int passes_ = 0;
};

}  // namespace rowland::post
