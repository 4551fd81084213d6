#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"
#include "engine/scene/ray.h"
#include "modules/diffraction/model/shading_point.h"

namespace rowland::inspector {

using scene::Ray;

/// A point of a mesh, in world axes.
struct PickedPoint {
    diffraction::ShadingPoint frame;  ///< as its shaders have it: toward the eye, the interpolated normal and tangent
    glm::dvec3 bitangent{0.0};        ///< unit
    glm::vec3 position{0.0F};
    glm::vec2 uv{0.0F};
    glm::vec2 uv1{0.0F};
    float distance = 0.0F;  ///< from the ray's origin, in lengths of its direction
};

/// The ray from the eye through a point of the picture, given from its upper left corner in [0, 1].
Ray ray_through(const scene::Camera& camera, float aspect, const glm::vec2& at);

/// The nearest point of a mesh on the ray. nullopt if the ray misses or the frame is not valid.
std::optional<PickedPoint> pick_point(const scene::Mesh& mesh, const glm::mat4& object_to_world, const Ray& ray);

/// The frame with its grating vector turned toward the bitangent.
diffraction::ShadingPoint turned(const PickedPoint& point, double radians);

}  // namespace rowland::inspector
