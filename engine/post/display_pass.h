#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"
#include "engine/post/ocio_config.h"

namespace rowland::post {

/// A display and one of its views; empty names mean the configuration's defaults.
struct DisplaySelection {
    std::string display;
    std::string view;
};

/// From the working space (the configuration's scene_linear) to the encoded values of a display: exposure, the view's
/// looks (gamut compression), the view transform, the display's encoding. NaN input becomes 0, and input is clamped
/// to the range of half floats, ±65504; output is not clamped. This is the CPU reference, and the source of the code
/// that DisplayPass runs on the GPU.
class DisplayTransform {
 public:
    /// Throws Error (input) if there is no such display or view (the message lists the existing ones and names the
    /// nearest), no scene_linear role, or a file the view needs is missing.
    explicit DisplayTransform(const OcioConfig& config, const DisplaySelection& selection = {});

    /// Replaces scene-linear pixels by display values. Not thread-safe.
    void apply_cpu(std::span<glm::vec3> pixels, float exposure_stops = 0.0F) const;

    const std::string& display() const { return selection_.display; }
    const std::string& view() const { return selection_.view; }
    const std::string& config_source() const { return config_source_; }
    const OCIO_NAMESPACE::ConstProcessorRcPtr& processor() const { return processor_; }

 private:
    DisplaySelection selection_;
    std::string config_source_;
    OCIO_NAMESPACE::ConstProcessorRcPtr processor_;
    OCIO_NAMESPACE::ConstCPUProcessorRcPtr cpu_;
};

/// A DisplayTransform on the GPU. Exposure is a uniform; a program is built only when the transform's code changes.
class DisplayPass {
 public:
    /// `library` must hold post::shader_files(). Throws as set_transform() does.
    DisplayPass(const gpu::ShaderLibrary& library, const DisplayTransform& transform);

    /// Shows another display or view from now on. Throws Error (input) if OpenColorIO cannot run it on the GPU.
    void set_transform(const gpu::ShaderLibrary& library, const DisplayTransform& transform);

    /// Writes display values for the scene-linear `source` (RGBA16F or RGBA32F), pixel by pixel; alpha is kept. The
    /// target must not be larger than the source.
    void draw(const gpu::Texture& source, float exposure_stops, const gpu::Framebuffer& target) const;

    /// A look-up texture that the transform's shader reads.
    struct Lut {
        std::string sampler;
        gpu::Texture texture;
    };

 private:
    void build(const gpu::ShaderLibrary& library, const std::string& source);
    void upload_luts();
    void set_uniforms() const;

    gpu::Program program_;
    gpu::FullScreenTriangle triangle_;
    OCIO_NAMESPACE::GpuShaderDescRcPtr shader_;
    std::vector<Lut> luts_;
    std::string cache_id_;
};

}  // namespace rowland::post
