#pragma once

#include <vector>

#include "engine/scene/camera.h"
#include "engine/scene/imported_scene.h"
#include "engine/scene/mesh.h"

namespace rowland::demo {

/// The views of a scene's cameras at rest, in the order of the file. A view's target, about which the user orbits, is
/// the nearest point of `merged`, the scene's triangles in the world, on the camera's axis; 1 m ahead if there is none.
/// A camera without a far plane gets one behind the scene.
std::vector<scene::Camera> all_views(const scene::ImportedScene& scene, const scene::Mesh& merged);

}  // namespace rowland::demo
