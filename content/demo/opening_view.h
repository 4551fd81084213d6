#pragma once

#include <vector>

#include "engine/scene/camera.h"
#include "engine/scene/imported_scene.h"
#include "engine/scene/mesh.h"

namespace rowland::demo {

/// The view of one of the scene's cameras, with the scene at rest. Its target, about which the user orbits, is what
/// lies in the middle of the picture: the nearest point of `merged`, the scene's triangles in the world, on the
/// camera's axis; 1 m ahead if there is none. A lens without a far plane gets one behind the scene.
scene::Camera view_of(const scene::ImportedCamera& lens, const scene::ImportedScene& scene, const scene::Mesh& merged);

/// Those of all its cameras, in the order of the file: the first one's is the opening view.
std::vector<scene::Camera> all_views(const scene::ImportedScene& scene, const scene::Mesh& merged);

}  // namespace rowland::demo
