#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "content/demo/play/pick.h"
#include "engine/ecs/world.h"
#include "modules/diffraction/model/frame.h"

namespace rowland::demo {

/// The frame that a grating is shaded with where a ray from `eye` meets it: toward the eye, the interpolated normal and
/// the grating vector there, world axes. Nothing where it is seen from behind, or has no directions.
std::optional<diffraction::Frame> frame_at(ecs::World& world, ecs::Entity grating, const TriangleHit& hit,
                                           const glm::vec3& point, const glm::vec3& eye);

/// A frame as `rowland-trade evaluate --frames` reads it: header and one row, every digit.
std::string frames_csv(const diffraction::Frame& frame);

}  // namespace rowland::demo
