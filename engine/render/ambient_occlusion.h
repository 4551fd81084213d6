#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/full_screen_pass.h"
#include "engine/render/effects.h"
#include "engine/render/program_cache.h"
#include "engine/scene/camera.h"

namespace rowland::render {

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
