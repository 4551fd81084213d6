#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>

#include "content/demo/play/pick.h"
#include "engine/ecs/world.h"
#include "modules/diffraction/model/frame.h"

namespace rowland::demo {

/// A mesh with grooves where it stands.
struct GratingPlace {
    std::shared_ptr<const scene::Mesh> mesh;
    glm::mat4 to_world{1.0F};
    float groove_rotation = 0.0F;  ///< as in DiffractionSurface
};

/// The place of an entity; nothing if it is no grating.
std::optional<GratingPlace> grating_place(ecs::World& world, ecs::Entity grating);

/// The frame that a grating is shaded with where a ray from `eye` meets it: toward the eye, the interpolated normal and
/// the grating vector there, world axes. Nothing where it is seen from behind, or has no directions.
std::optional<diffraction::Frame> frame_at(const GratingPlace& place, const TriangleHit& hit, const glm::vec3& point,
                                           const glm::vec3& eye);

/// A frame as `rowland-trade evaluate --frames` reads it: header and one row, every digit.
std::string frames_csv(const diffraction::Frame& frame);

}  // namespace rowland::demo
