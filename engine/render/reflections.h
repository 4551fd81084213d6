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
/// A reflected ray meets a known plane without a search and without noise, also where the camera does not see the
/// plane. Reflections from the picture's pixels would miss what the camera does not see.
struct ReflectedTop {
    glm::vec3 centre{0.0F};
    glm::vec2 half{0.0F};       ///< of its sides along x and z
    glm::mat2 uv_linear{0.0F};  ///< from x and z relative to the centre to texture coordinates
    glm::vec2 uv_offset{0.0F};
};

/// The rectangle of a mesh's bounds at their highest y, with the texture coordinates of the largest triangle there.
ReflectedTop top_of(const scene::Mesh& mesh);

/// The light on a plane, in the working space.
struct PlaneLight {
    std::function<const LitProbe&(const glm::vec3&)> probe_at;  ///< the probe of the larger part of light_at()
    const SceneLights& lights;
    glm::mat3 rec709_to_working{1.0F};
};

/// Reflections of the plane in mirrors. The plane is a dielectric: it reflects ambient and directional light diffusely,
/// and the environment in a lobe of its roughness. Highlights, point lights and spot lights are left out.
class LocalReflection {
 public:
    /// Takes the plane of the frame and its light. False if there is no plane. `pixel_angle`: that a pixel subtends,
    /// radians.
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

/// The camera at `centre` that looks through a face of a cube map. The face's first row of texels is the picture's
/// lowest.
scene::Camera cube_face_camera(int face, const glm::vec3& centre);

/// The light from objects around a point and their distance, as two cube maps. A mirror near the point searches them
/// for what its rays meet [Szirmay-Kalos et al. 2005, "Approximate ray-tracing on the GPU with distance impostors"]:
/// for any camera, without noise. What the point does not see, mirrors do not show.
class ObjectReflection {
 public:
    static constexpr int kFaces = 6;

    /// With empty surroundings. `face_size`: texels along a side of a cube map's face.
    explicit ObjectReflection(int face_size);

    scene::Camera camera(int face) const { return cube_face_camera(face, centre); }
    /// Fills a face from a picture by camera(face), of the face's size, and the picture's depth.
    void store(ProgramCache& programs, const gpu::FullScreenTriangle& triangle, const gpu::Framebuffer& picture,
               int face);
    /// Updates the smaller levels; call it after store().
    void finish() { light_.generate_levels(); }
    /// Binds both maps for draws by a program, which must be in use.
    void bind(const gpu::Program& program) const;

    glm::vec3 centre{0.0F};
    Hash128 scene;             ///< of the light and the objects: if it changes, all faces are drawn again at once
    Hash128 motion;            ///< of what moves: if it changes, faces are drawn again, one per frame
    int stale_faces = kFaces;  ///< number of faces to be drawn again, from next_face on
    bool all_at_once = true;   ///< in the next frame, instead of one per frame
    int next_face = 0;
    gpu::StreamBuffer frame_data;  ///< the renderer's, while faces are drawn

 private:
    gpu::Texture light_;                     ///< working space, 0 where nothing is; alpha: 1 where an object is
    gpu::Texture nearness_;                  ///< 1 / distance, metres; 0: nothing
    std::vector<gpu::Framebuffer> targets_;  ///< light and nearness of each face
};

/// The ObjectReflection of each group, and what drawing them needs.
struct ObjectReflections {
    static constexpr int kFaceSize = 256;

    ObjectReflections();
    /// Makes it if the group has none.
    ObjectReflection& of(ecs::Entity group);

    ObjectReflection nothing{1};  ///< what mirrors in another mirror's surroundings reflect
    gpu::Texture all_visible;     ///< bound for the surroundings instead of AmbientOcclusion::visibility()
    gpu::Framebuffer picture{{.width = kFaceSize, .height = kFaceSize, .depth = true}};
    gpu::FullScreenTriangle triangle;

 private:
    std::map<std::pair<std::uint32_t, std::uint32_t>, ObjectReflection> of_groups_;
};

}  // namespace rowland::render
