#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <string>
#include <vector>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/full_screen_pass.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"
#include "engine/post/display_transform.h"

namespace rowland::post {

/// A DisplayTransform on the GPU. Exposure is a uniform; a program is built only when the transform's code changes.
class DisplayPass {
 public:
    /// `library` must hold post::shader_files().
    DisplayPass(const gpu::ShaderLibrary& library, const DisplayTransform& transform);

    /// Shows another display or view from now on.
    void set_transform(const gpu::ShaderLibrary& library, const DisplayTransform& transform);

    /// Writes display values for the scene-linear `source` (RGBA16F or RGBA32F), pixel by pixel; alpha is kept. The
    /// target must not be larger than the source.
    void draw(const gpu::Texture& source, float exposure_stops, const gpu::Framebuffer& target) const;

    /// How often a program was compiled so far.
    int program_builds() const { return program_builds_; }

 private:
    struct Lut {
        std::string sampler;
        gpu::Texture texture;
    };
    void build(const gpu::ShaderLibrary& library, const std::string& source);
    void upload_luts();
    void set_uniforms() const;

    gpu::Program program_;
    gpu::FullScreenTriangle triangle_;
    OCIO_NAMESPACE::GpuShaderDescRcPtr shader_;
    std::vector<Lut> luts_;
    std::string cache_id_;
    int program_builds_ = 0;
};

}  // namespace rowland::post
