#pragma once

#include <optional>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"

namespace rowland::post {

/// A thin lens with a round aperture in front of a sensor that is 24 mm high. Points at other distances than the focus
/// become discs.
struct DepthOfFieldSettings {
    float f_number = 2.8F;              ///< focal length over the aperture's diameter, 0.5 to 64
    std::optional<float> focus_m = {};  ///< along the camera's axis, above 0; null: the camera's target
    float most_blur = 0.03F;            ///< radius of the largest disc in picture heights, above 0, at most 0.1
};

/// The camera's parameters that the blur depends on.
struct LensView {
    float vertical_fov = 0.7F;  ///< radians, in (0, pi)
    float near_plane = 0.01F;   ///< metres
    float far_plane = 100.0F;   ///< metres
    float target_m = 1.0F;      ///< distance along the axis, metres
};

/// Radius of a point's disc in picture heights, negative nearer than the focus, unclamped:
///   f^2 / (2 N h (focus - f)) * (distance - focus) / distance,  f = h / (2 tan(fov / 2)),  h = 24 mm.
/// A focus nearer than 1.1 f counts as 1.1 f.
float blur_radius(const DepthOfFieldSettings& settings, const LensView& view, float distance_m);

/// Gathers for each pixel the light that the lens spreads over it, by samples on a golden spiral as wide as the widest
/// disc nearby. A sample reads the mip level whose texels fill the space between samples. Energy is conserved except
/// where discs of different distances meet. Nearer surfaces cover the pixel's own. The discs of farther ones count as
/// at most twice as wide as the disc of the pixel's own, so that sharp edges stay sharp.
class DepthOfFieldPass {
 public:
    /// `library` must hold post::shader_files().
    explicit DepthOfFieldPass(const gpu::ShaderLibrary& library);

    /// Writes the blurred picture; alpha is kept. Source (RGBA16F or RGBA32F), depth and target have the same size,
    /// else it is a logic error.
    void draw(const gpu::Texture& source, const gpu::Texture& depth, const DepthOfFieldSettings& settings,
              const LensView& view, const gpu::Framebuffer& target);
    static constexpr int passes() { return 3; }

 private:
    struct Targets {
        gpu::Texture discs;  ///< colour, and the disc's radius in pixels
        gpu::Framebuffer onto_discs;
        gpu::Framebuffer widest;  ///< radius in a tile
    };

    gpu::Program discs_program_;
    gpu::Program widest_program_;
    gpu::Program gather_program_;
    gpu::FullScreenTriangle triangle_;
    std::optional<Targets> targets_;
};

/// A logic error if a setting is out of range.
void require_valid(const DepthOfFieldSettings& settings);

}  // namespace rowland::post
