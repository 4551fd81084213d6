#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "content/demo/play/pick.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"

namespace rowland::demo {

/// A mesh that stands in a scene.
struct PlacedMesh {
    std::shared_ptr<const scene::Mesh> mesh;
    glm::mat4 to_world{1.0F};
};

/// What a camera sees in the middle of a texel.
struct VisiblePoint {
    std::size_t mesh = 0;  ///< which of the placed ones
    TriangleHit hit;       ///< its distance in metres
    glm::vec3 point{0.0F};
};

/// A picture of so many texels, row by row from its top: the nearest front or back of all meshes. Triangles that reach
/// behind the near plane are left out.
std::vector<std::optional<VisiblePoint>> visible_points(const scene::Camera& camera, glm::ivec2 size,
                                                        const std::vector<PlacedMesh>& meshes);

}  // namespace rowland::demo
