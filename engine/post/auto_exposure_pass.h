#pragma once

#include <optional>
#include <vector>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/full_screen_pass.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"

namespace rowland::post {

/// mean_log2_luminance on the GPU: each pass sums blocks of 8×8 texels, down to one.
class AutoExposurePass {
 public:
    /// `library` must hold post::shader_files().
    explicit AutoExposurePass(const gpu::ShaderLibrary& library);

    /// As mean_log2_luminance, to 1e-3. Waits for the GPU: the result is of this very picture.
    std::optional<double> measure(const gpu::Texture& picture, const glm::vec3& weights, float darkest);

    /// How many passes the last measurement took: 4 for 1920×1080.
    int passes() const { return static_cast<int>(sums_.size()); }

 private:
    void make_sums(glm::ivec2 size);

    gpu::Program sum_picture_;
    gpu::Program sum_sums_;
    gpu::FullScreenTriangle triangle_;
    std::vector<gpu::Framebuffer> sums_;  ///< sum of logarithms in red, count in green; the last is one texel
    glm::ivec2 size_{0};
};

}  // namespace rowland::post
