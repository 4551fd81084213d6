#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"
#include "engine/scene/ray.h"
#include "modules/diffraction/model/shading_point.h"

namespace rowland::inspector {

using scene::Ray;

/// The ray from the eye through a point of the picture, given from its upper left corner in [0, 1].
Ray ray_through(const scene::Camera& camera, float aspect, const glm::vec2& at);

/// The frame of the nearest point of a mesh on the ray, in world axes, as its shaders have it: toward the eye, the
/// interpolated normal and grating vector. nullopt if the ray misses or the frame is not valid.
std::optional<diffraction::ShadingPoint> pick_point(const scene::Mesh& mesh, const glm::mat4& object_to_world,
                                                    const Ray& ray);

}  // namespace rowland::inspector
