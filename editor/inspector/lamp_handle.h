#pragma once

#include <glm/vec2.hpp>

#include "editor/inspector/preview.h"
#include "engine/scene/camera.h"

namespace rowland::inspector {

/// The lamp's handle in the preview: a point on a sphere around the camera's target, in the direction of the lamp. The
/// sphere has the same size in the picture at all distances.
struct LampHandle {
    glm::vec2 at{0.0F};      ///< in the picture, from its upper left corner, in [0, 1]
    glm::vec2 centre{0.0F};  ///< of the sphere, likewise
    bool behind = false;     ///< on the side of the sphere that is away from the eye
};
LampHandle lamp_handle(const scene::Camera& camera, float aspect, const Stage& stage);

/// Turns the lamp so that its handle is at a point of the picture, on the side of the sphere where it was; at the rim
/// if the point is outside. The elevation ends at the horizon.
void drag_lamp(Stage& stage, const scene::Camera& camera, float aspect, const glm::vec2& at, bool behind);

}  // namespace rowland::inspector
