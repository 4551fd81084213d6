#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/gpu/framebuffer.h"
#include "engine/render/surface_programs.h"
#include "engine/scene/camera.h"

namespace rowland::render {

/// Occlusion by what the picture shows, from its depth: of ambient light, and of the light that casts shadows close to
/// where things touch.
struct AmbientOcclusionSettings {
    float radius_m = 0.1F;    ///< farthest occluder of ambient light; above 0
    float contact_m = 0.01F;  ///< length of a contact shadow's ray; 0: none

    friend bool operator==(const AmbientOcclusionSettings&, const AmbientOcclusionSettings&) = default;
};

/// The light that casts shadows is a disc, whose shadows' edges widen with the distance from what casts them.
struct SoftShadowSettings {
    float angular_radius = 0.03F;  ///< of the light, radians

    friend bool operator==(const SoftShadowSettings&, const SoftShadowSettings&) = default;
};

/// Effects on a surface's light that the renderer adds. Each that is off costs nothing.
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
/// turned from pixel to pixel in a pattern of 4×4. Normals are those of the depth. A mean over 7×7 pixels of similar
/// depth removes the pattern, so that nothing changes from frame to frame but what moves.
///
/// The light that casts shadows: a short ray toward it through the depth, which darkens what a shadow map's bias leaves
/// bright.
class AmbientOcclusion {
 public:
    /// Makes textures for a picture of this size and clears the depth. Draw what is seen there, then call draw().
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
