#pragma once

#include "engine/scene/camera.h"
#include "engine/scene/imported_scene.h"
#include "engine/scene/mesh.h"

namespace rowland::demo {

/// The view of the scene's first camera, with the scene at rest. Its target, about which the user orbits, is what lies
/// in the middle of the picture: the nearest point of `merged`, the scene's triangles in the world, on the camera's
/// axis; 1 m ahead if there is none. A lens without a far plane gets one behind the scene. The scene must have a
/// camera.
scene::Camera opening_view(const scene::ImportedScene& scene, const scene::Mesh& merged);

}  // namespace rowland::demo
