#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "content/demo/play/body.h"
#include "engine/ecs/world.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::demo {

/// A mesh with grooves, and its pose.
struct PlacedGrating {
    std::shared_ptr<const scene::Mesh> mesh;
    glm::mat4 to_world{1.0F};
    float groove_rotation = 0.0F;  ///< as in DiffractionSurface
};

/// The grating of an entity; nullopt if it has none.
std::optional<PlacedGrating> placed_grating(ecs::World& world, ecs::Entity grating);

/// The shading frame of a grating where a ray from `eye` hits it: direction to the eye, interpolated normal and grating
/// vector, in world axes. Nullopt where it is seen from behind or its tangent frame is degenerate.
std::optional<diffraction::ShadingPoint> frame_at(const PlacedGrating& grating, const TriangleHit& hit,
                                                  const glm::vec3& point, const glm::vec3& eye);

/// A frame as `rowland-trade evaluate --frames` reads it: header and one row, exact.
std::string frames_csv(const diffraction::ShadingPoint& frame);

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
