#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"

namespace rowland::render {

struct Sphere {
    glm::vec3 centre{0.0F};
    float radius = 0.0F;
};

/// Around what a camera sees up to `far_distance` along its axis; the same size however the camera turns and moves.
Sphere around_view(const scene::Camera& camera, float aspect, float far_distance);

/// How a parallel shadow map looks at the scene.
struct ShadowView {
    glm::mat4 world_to_clip{1.0F};
    float texel_m = 1.0F;  ///< width of a texel in the world

    /// Whether the box casts into the map, at any depth.
    bool may_see(const scene::Bounds& box) const;
};

/// Fits a square map of `size` texels to the casters whose shadow can be seen: their boxes' extent across the light,
/// cut to the seen sphere's. Depth spans all casters, so none is lost. Sizes are rounded to steps of 2^¼ and the
/// position to whole texels, so that a shadow's edge does not crawl as camera and casters move.
ShadowView fit_shadow(const glm::vec3& toward_light, std::span<const scene::Bounds> casters, const Sphere& seen,
                      int size);

}  // namespace rowland::render
