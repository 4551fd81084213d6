#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/material.h"
#include "engine/render/shaders/scene_blocks.h"
#include "engine/render/surface_programs.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"

namespace rowland::render {

/// Axis-parallel box around a transformed box [Arvo 1990].
scene::Bounds transformed(const scene::Bounds& box, const glm::mat4& matrix);

/// Smallest box around all boxes; nullopt if there are none.
std::optional<scene::Bounds> united(std::span<const scene::Bounds> boxes);

/// Box around a skinned mesh in a pose: a vertex is a weighted mean of its positions under single joints, so the
/// joints' boxes contain it.
scene::Bounds posed_bounds(const scene::Bounds& box, std::span<const glm::mat4> joints);

/// A camera's view volume as six planes that face inward [Gribb & Hartmann 2001].
class Frustum {
 public:
    explicit Frustum(const glm::mat4& view_projection);
    /// False only if the box is wholly outside one plane: some invisible boxes near a corner pass.
    bool may_see(const scene::Bounds& box) const;

 private:
    std::array<glm::vec4, 6> planes_;
};

/// The lights of a world, as shaders read them.
struct SceneLights {
    LightBlock block = {};                  ///< directional lights before others, the one that casts shadows first
    std::vector<glm::vec3> strengths;       ///< see FrameLight::light_strengths
    std::optional<glm::vec3> shadow_light;  ///< direction toward it
    int dropped = 0;                        ///< number beyond ROWLAND_MAXIMUM_LIGHTS

    /// The bits of feature::kLights that they need.
    SurfaceFeatures features() const;
};

/// All lights in world axes, each transformed by its WorldMatrix if it has one.
SceneLights gather_lights(ecs::World& world, const glm::dmat3& rec709_to_working);

/// All directional lights, also those that gather_lights() drops.
std::vector<DistantLight> distant_lights(ecs::World& world);

struct Sphere {
    glm::vec3 centre{0.0F};
    float radius = 0.0F;
};

/// Sphere around the view volume up to `far_distance` along its axis; its size does not depend on the camera's pose.
Sphere around_view(const scene::Camera& camera, float aspect, float far_distance);

/// Orthographic view of the scene from a directional light.
struct ShadowView {
    glm::mat4 world_to_clip{1.0F};
    float texel_m = 1.0F;  ///< width of a texel in the world

    /// Whether the box overlaps the map across the light, at any depth.
    bool may_see(const scene::Bounds& box) const;
};

/// Fits a square map of `size` texels to the casters whose shadow can be seen: their boxes' extent across the light,
/// clipped to that of the sphere `seen`. Depth spans all casters, so none is lost. Sizes are rounded to steps of 2^¼
/// and the position to whole texels, so that a shadow's edge does not crawl as camera and casters move.
ShadowView fit_shadow(const glm::vec3& toward_light, std::span<const scene::Bounds> casters, const Sphere& seen,
                      int size);

/// Radius of a disc light's penumbra, in widths of the map, for a blocker that is the map's whole depth away.
/// `angular_radius`: of the light, radians; `size`: of the map, texels.
///
/// Shaders multiply it by the mean distance of the blockers about a point, which gives the radius over which
/// comparisons with the shadow map are averaged: percentage-closer soft shadows (Fernando 2005). A tilted surface is
/// compared with its own plane. Exact under one straight edge; blockers at different depths are replaced by one at
/// their mean depth.
float penumbra_over_depth(const ShadowView& view, int size, float angular_radius);

}  // namespace rowland::render
