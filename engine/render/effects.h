#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/gpu/framebuffer.h"
#include "engine/render/surface_programs.h"
#include "engine/scene/camera.h"

namespace rowland::render {

/// Screen-space occlusion, from the picture's depth: of ambient light, and of the light that casts shadows close to
/// where objects touch.
struct AmbientOcclusionSettings {
    float radius_m = 0.1F;    ///< farthest occluder of ambient light; above 0
    float contact_m = 0.01F;  ///< length of a contact shadow's ray; 0: none

    friend bool operator==(const AmbientOcclusionSettings&, const AmbientOcclusionSettings&) = default;
};

/// Shadows of a disc light: their edges widen with the distance from what casts them.
struct SoftShadowSettings {
    float angular_radius = 0.03F;  ///< of the light, radians

    friend bool operator==(const SoftShadowSettings&, const SoftShadowSettings&) = default;
};

/// Effects on a surface's light that the renderer adds. An effect that is off costs nothing.
struct Effects {
    std::optional<AmbientOcclusionSettings> ambient_occlusion = std::nullopt;
    std::optional<SoftShadowSettings> soft_shadows = std::nullopt;
    bool local_reflections = false;   ///< mirrors show what has a ReflectedTop
    bool object_reflections = false;  ///< what has ReflectsObjects mirrors the objects around it
    bool rough_reflections = false;   ///< a rough surface looks the environment up in four directions, not in one

    friend bool operator==(const Effects&, const Effects&) = default;
};

/// Visibility of light, from the depth of a picture at half its size.
///
/// Ambient light: ground-truth ambient occlusion (Jimenez et al. 2016, "Practical realtime strategies for accurate
/// indirect occlusion", eqs. 7 and 10): the cosine-weighted visibility within the horizons of two slices, which are
/// rotated from pixel to pixel in a pattern of 4×4. Normals are computed from the depth. A mean over 7×7 pixels of
/// similar depth removes the pattern; it is the same in each frame, so that nothing flickers.
///
/// The light that casts shadows: a short ray toward it through the depth, which darkens what a shadow map's bias leaves
/// bright.
class AmbientOcclusion {
 public:
    /// Makes textures for a picture of this size; clears, binds and returns the depth. Draw the visible surfaces into
    /// it, then call draw().
    const gpu::Framebuffer& begin(glm::ivec2 picture);
    /// `toward_light`: unit, world axes; none: no contact shadows.
    void draw(ProgramCache& programs, const scene::Camera& camera, float aspect,
              const std::optional<glm::vec3>& toward_light, const AmbientOcclusionSettings& settings);
    /// Visibility of ambient light, of the light that casts shadows, and depth along the camera's axis in metres.
    const gpu::Texture& visibility() const { return targets_->smooth.colour(); }

 private:
    struct Targets {
        gpu::Framebuffer depth;
        gpu::Framebuffer across;  ///< the mean along rows
        gpu::Framebuffer smooth;
    };
    std::optional<Targets> targets_;
    gpu::FullScreenTriangle triangle_;
};

}  // namespace rowland::render
