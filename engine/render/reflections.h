#pragma once

#include <cstdint>
#include <functional>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/file.h"
#include "engine/ecs/world.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "engine/lighting/light_probe.h"
#include "engine/render/probe_volumes.h"
#include "engine/render/scene_lights.h"
#include "engine/render/surface_programs.h"
#include "engine/scene/camera.h"
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
    std::function<const LitProbe&(const glm::vec3&)> probe_at;  ///< that lights most at a point
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

/// Component of a drawn entity: it mirrors the opaque objects around its group where it would mirror the environment.
/// glTF nodes have it by their extras, with all nodes below them as one group: `"reflects_objects": true`.
struct ReflectsObjects {
    ecs::Entity group;  ///< a mirror shows nothing of its own group
};

/// From `centre` through a face of a cube map, whose first row of texels is the picture's lowest.
scene::Camera cube_face_camera(int face, const glm::vec3& centre);

/// The light from objects around a point and their distance, as two cube maps. A mirror near the point searches them
/// for what its rays meet [Szirmay-Kalos et al. 2005, "Approximate ray-tracing on the GPU with distance impostors"]:
/// for any camera, without noise. What the point does not see, mirrors do not show.
class ObjectReflection {
 public:
    static constexpr int kFaces = 6;

    /// Of a cube map's face, of so many texels; 1: for empty surroundings.
    explicit ObjectReflection(int face_size);

    scene::Camera camera(int face) const { return cube_face_camera(face, centre); }
    /// Takes a face from a picture that shows it, of twice the size, and the picture's depth.
    void store(ProgramCache& programs, const gpu::FullScreenTriangle& triangle, const gpu::Framebuffer& picture,
               int face);
    /// After all faces are stored.
    void finish() { light_.generate_levels(); }
    /// For draws by a program in use.
    void bind(const gpu::Program& program) const;

    glm::vec3 centre{0.0F};
    Hash128 scene;             ///< of what all faces must be drawn again for: light, objects
    Hash128 motion;            ///< of what one face in a frame is enough for
    int stale_faces = kFaces;  ///< from next_face on
    bool all_at_once = true;   ///< not one in a frame
    int next_face = 0;
    gpu::StreamBuffer frame_data;  ///< as the renderer's

 private:
    gpu::Texture light_;                     ///< working space, times coverage; alpha: coverage
    gpu::Texture nearness_;                  ///< 1 / distance, metres; 0: nothing
    std::vector<gpu::Framebuffer> targets_;  ///< light and nearness of each face
};

/// Those of all groups, and what it takes to draw them.
struct ObjectReflections {
    static constexpr int kFaceSize = 128;

    ObjectReflections();
    ObjectReflection& of(ecs::Entity group);

    ObjectReflection nothing{1};  ///< what mirrors mirror in another's surroundings
    gpu::Texture all_visible;     ///< used there instead of AmbientOcclusion::visibility()
    gpu::Framebuffer picture{{.width = 2 * kFaceSize, .height = 2 * kFaceSize, .depth = true}};
    gpu::FullScreenTriangle triangle;

 private:
    std::map<std::pair<std::uint32_t, std::uint32_t>, ObjectReflection> of_groups_;
};

}  // namespace rowland::render
