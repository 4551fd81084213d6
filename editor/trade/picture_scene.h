#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/trade/frame_sets.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/evaluate/measured_picture.h"

namespace rowland::trade {

/// The scene of pictures and of timed frames: a compact disc in the XZ plane with a sphere over its hole, both of one
/// grating. Timed frames show the disc alone.
scene::Mesh disc_mesh();                                       ///< 25 000 vertices
scene::Mesh sphere_mesh();                                     ///< centred at its origin
inline constexpr glm::vec3 kSphereCentre{0.0F, 0.022F, 0.0F};  ///< metres

/// For times: the disc covers half of a wide picture.
scene::Camera close_camera();
/// For errors: disc and sphere are in view as a whole.
scene::Camera far_camera();

/// The points of the scene that a camera sees, one per pixel. Both surfaces are exact, not meshes.
struct PictureFrames : diffraction::PictureLayout {
    FrameSet frames;  ///< "picture": the disc's points, then the sphere's
};
PictureFrames picture_frames(const scene::Camera& camera, int width, int height);

}  // namespace rowland::trade
