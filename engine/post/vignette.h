#pragma once

#include <optional>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"

namespace rowland::post {

/// Darkening towards the picture's corners: a simple lens's, an artistic one, or their product. With o = pixel centre -
/// picture centre, in pixels, light is multiplied by cos⁴θ · artistic:
///   cos⁴θ = 1 / (1 + t²)²,  t = tan(vertical_fov / 2) · |o| / (height / 2),
///   artistic = 1 - strength · smoothstep(radius, radius + softness, |o| / (diagonal / 2)).
struct VignetteSettings {
    /// The camera's, radians, in (0, π). Null, as for an orthographic camera: no darkening by the lens.
    std::optional<float> vertical_fov = {};
    float strength = 0.0F;  ///< fraction of the light that the corners lose, 0 to 1
    float radius = 0.6F;    ///< where that begins: 0 is the centre, 1 the corners. At least 0
    float softness = 0.4F;  ///< distance over which it grows to full strength, in the same measure; above 0
};

class VignettePass {
 public:
    /// `library` must hold post::shader_files().
    explicit VignettePass(const gpu::ShaderLibrary& library);

    /// Writes the darkened picture; alpha is kept. Source (RGBA16F or RGBA32F) and target have the same size, else it
    /// is a logic error.
    void draw(const gpu::Texture& source, const VignetteSettings& settings, const gpu::Framebuffer& target) const;

 private:
    gpu::Program program_;
    gpu::FullScreenTriangle triangle_;
};

/// False if the factor is 1 everywhere.
bool has_effect(const VignetteSettings& settings);

/// A logic error if a setting is out of range.
void require_valid(const VignetteSettings& settings);

}  // namespace rowland::post
