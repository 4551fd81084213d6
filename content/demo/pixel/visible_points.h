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

struct PlacedMesh {
    std::shared_ptr<const scene::Mesh> mesh;
    glm::mat4 to_world{1.0F};
};

/// What a camera sees at the centre of a texel.
struct VisiblePoint {
    std::size_t mesh = 0;  ///< index
    TriangleHit hit;       ///< its distance in metres
    glm::vec3 point{0.0F};
};

/// The nearest point of all meshes, front or back, at each texel, row by row from the top. Triangles that reach behind
/// the near plane are left out.
std::vector<std::optional<VisiblePoint>> visible_points(const scene::Camera& camera, glm::ivec2 size,
                                                        const std::vector<PlacedMesh>& meshes);

}  // namespace rowland::demo
