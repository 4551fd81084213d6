#pragma once

#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "engine/ecs/world.h"
#include "engine/gpu/stream_buffer.h"
#include "engine/gpu/texture.h"
#include "engine/lighting/ambient.h"
#include "engine/render/scene_lights.h"
#include "engine/scene/mesh.h"

namespace rowland::render {

/// Component of a drawn entity: mirrors show the top of its mesh, as a rectangle, where they would show the
/// environment. Of several, one is shown. In the mesh's own space; glTF nodes have it by their extras:
/// `"reflected_top": true`.
///
/// A known plane is met by every reflected ray, seen or not, without a search and without noise; the picture's own
/// pixels would show mirrors nothing of what they face away from the viewer.
struct ReflectedTop {
    glm::vec3 centre{0.0F};
    glm::vec2 half{0.0F};       ///< of its sides along x and z
    glm::mat2 uv_linear{0.0F};  ///< from x and z, from the centre, to texture coordinates
    glm::vec2 uv_offset{0.0F};
};

/// Of a mesh: the rectangle of its bounds at their highest y, with the texture coordinates of the largest triangle
/// there.
ReflectedTop top_of(const scene::Mesh& mesh);

/// The light on a plane, in the working space.
struct PlaneLight {
    const lighting::AmbientLight& ambient;
    std::span<const lighting::KeyLight> keys;
    const SceneLights& lights;
    glm::mat3 rec709_to_working{1.0F};
};

/// Reflections of the plane, as of a dielectric: it reflects ambient and directional light diffusely, and the
/// environment in a lobe of its roughness. Highlights, points and spots are left out.
class LocalReflection {
 public:
    /// Takes over the frame's plane and its light. False if there is none. `pixel_angle`: of a pixel, radians.
    bool update(ecs::World& world, const PlaneLight& light, float pixel_angle);
    void bind() const;
    /// Whether a box lies below the plane, where mirrors show the plane alone.
    bool covers(const scene::Bounds& box) const;

 private:
    gpu::StreamBuffer block_;
    glm::vec3 normal_{0.0F, 1.0F, 0.0F};  ///< of the plane, unit
    float height_ = 0.0F;                 ///< of its points along the normal
    const gpu::Texture* map_ = nullptr;
};

}  // namespace rowland::render
