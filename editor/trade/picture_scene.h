#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/trade/frame_sets.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"

namespace rowland::trade {

/// The scene that pictures are made of and frames are timed on: a compact disc that lies in the XZ plane with a sphere
/// over its hole, both of one grating.
scene::Mesh disc_mesh();                                       ///< 25 000 vertices
scene::Mesh sphere_mesh();                                     ///< around its own centre
inline constexpr glm::vec3 kSphereCentre{0.0F, 0.022F, 0.0F};  ///< metres

/// Sees the disc over half of a wide picture: for times.
scene::Camera close_camera();
/// Sees disc and sphere whole: for errors.
scene::Camera far_camera();

/// What a camera sees of the scene, pixel by pixel; both surfaces are exact, not meshes.
struct PictureFrames {
    int width = 0;
    int height = 0;
    FrameSet frames;                  ///< "picture": the disc's points, then the sphere's
    std::vector<std::size_t> pixels;  ///< of each point of all_frames(): row · width + column, row 0 at the top
};
PictureFrames picture_frames(const scene::Camera& camera, int width, int height);

/// XYZ of a picture's pixels, black where nothing is.
std::vector<glm::dvec3> picture(const PictureFrames& frames, std::span<const glm::dvec3> radiance);

}  // namespace rowland::trade
