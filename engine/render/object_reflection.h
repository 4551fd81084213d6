#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/ecs/entity.h"
#include "engine/gpu/framebuffer.h"
#include "engine/gpu/full_screen_pass.h"
#include "engine/gpu/program.h"
#include "engine/gpu/stream_buffer.h"
#include "engine/gpu/texture.h"
#include "engine/render/program_cache.h"
#include "engine/scene/camera.h"

namespace rowland::render {

/// Component of a drawn entity: it mirrors the opaque objects around its group where it would mirror the environment.
/// glTF nodes have it by their extras, with all nodes below them as one group: `"reflects_objects": true`.
struct ReflectsObjects {
    ecs::Entity group;  ///< a mirror shows nothing of its own group
};

/// The light from objects around a point and their distance, as two cube maps. A mirror near the point searches them
/// for what its rays meet [Szirmay-Kalos et al. 2005, "Approximate ray-tracing on the GPU with distance impostors"]:
/// for any camera, without noise. What the point does not see, mirrors do not show.
class ObjectReflection {
 public:
    static constexpr int kFaces = 6;

    /// Of a cube map's face, of so many texels; 1: for empty surroundings.
    explicit ObjectReflection(int face_size);

    /// The view of a face from the centre.
    scene::Camera camera(int face) const;
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
