#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/trade/frame_sets.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"

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
struct PictureFrames {
    int width = 0;
    int height = 0;
    FrameSet frames;                  ///< "picture": the disc's points, then the sphere's
    std::vector<std::size_t> pixels;  ///< of each point of all_frames(): row · width + column, row 0 at the top
};
PictureFrames picture_frames(const scene::Camera& camera, int width, int height);

/// XYZ of a picture's pixels; black where the camera sees no surface.
std::vector<glm::dvec3> picture(const PictureFrames& frames, std::span<const glm::dvec3> radiance);

}  // namespace rowland::trade
