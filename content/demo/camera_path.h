#pragma once

#include <vector>

#include "engine/scene/camera.h"
#include "engine/scene/imported_scene.h"
#include "engine/scene/mesh.h"

namespace rowland::demo {

/// The camera of a flight once around `start`'s target, `progress` in 0 to 1. It begins and ends at `start`; on the way
/// it first rises above the scene, then comes down to grazing views.
scene::Camera flight(const scene::Camera& start, double progress);

/// `start` rotated about the vertical through its target; `progress`: fraction of a full turn.
scene::Camera turned(const scene::Camera& start, double progress);

/// The camera of a smooth flight through all views, at `progress` in 0 to 1. All legs take the same time. There must be
/// at least one view; a single view is circled by flight().
scene::Camera tour(const std::vector<scene::Camera>& views, double progress);

/// The views of a scene's cameras at rest, in the order of the file. A view's target, about which the user orbits, is
/// the nearest point of `merged`, the scene's triangles in the world, on the camera's axis; 1 m ahead if there is none.
/// A camera without a far plane gets one behind the scene.
std::vector<scene::Camera> all_views(const scene::ImportedScene& scene, const scene::Mesh& merged);

}  // namespace rowland::demo
