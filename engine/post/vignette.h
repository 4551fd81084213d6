#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace rowland::post {

/// Darkening towards the picture's corners: that of a simple lens, one by taste, or their product.
struct VignetteSettings {
    /// The camera's, radians, in (0, π): a lens dims by cos⁴ of the angle to its axis. Without it there is no such
    /// darkening, nor with an orthographic camera.
    std::optional<float> vertical_fov = {};
    float strength = 0.0F;  ///< by taste: the share of light lost outermost, 0 to 1
    float radius = 0.6F;    ///< where that begins; 0 is the centre and 1 the corners. At least 0
    float softness = 0.4F;  ///< over what distance it grows to full strength, in the same measure; above 0
};

/// The factor on the light of a pixel. With o = pixel centre - picture centre, in pixels:
///   cos⁴θ = 1 / (1 + t²)²,  t = tan(vertical_fov / 2) · |o| / (height / 2),
///   taste = 1 - strength · smoothstep(radius, radius + softness, |o| / (diagonal / 2)),
/// and the factor is their product.
float vignette_factor(glm::ivec2 pixel, glm::ivec2 size, const VignetteSettings& settings);

/// Multiplies a scene-linear picture, row by row, by vignette_factor. The twin of VignettePass. It is a logic error if
/// `size` is not that of `pixels` or the settings are out of range.
void apply_vignette(std::span<glm::vec3> pixels, glm::ivec2 size, const VignetteSettings& settings);

/// False if the factor is 1 everywhere.
bool has_effect(const VignetteSettings& settings);

/// A logic error if a setting is out of range.
void require_valid(const VignetteSettings& settings);

}  // namespace rowland::post
