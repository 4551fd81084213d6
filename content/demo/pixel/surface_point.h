#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>

#include "content/demo/play/pick.h"
#include "engine/ecs/world.h"
#include "modules/diffraction/model/shading_point.h"

namespace rowland::demo {

/// A mesh with grooves, and its pose.
struct PlacedGrating {
    std::shared_ptr<const scene::Mesh> mesh;
    glm::mat4 to_world{1.0F};
    float groove_rotation = 0.0F;  ///< as in DiffractionSurface
};

/// Of an entity; nullopt if it is no grating.
std::optional<PlacedGrating> placed_grating(ecs::World& world, ecs::Entity grating);

/// The shading frame of a grating where a ray from `eye` hits it: direction to the eye, interpolated normal and grating
/// vector, in world axes. Nullopt where it is seen from behind or its tangent frame is degenerate.
std::optional<diffraction::ShadingPoint> frame_at(const PlacedGrating& grating, const TriangleHit& hit,
                                                  const glm::vec3& point, const glm::vec3& eye);

/// A frame as `rowland-trade evaluate --frames` reads it: header and one row, exact.
std::string frames_csv(const diffraction::ShadingPoint& frame);

}  // namespace rowland::demo
