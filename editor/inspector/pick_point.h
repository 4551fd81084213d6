#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "editor/inspector/preview_object.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"
#include "engine/scene/ray.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::inspector {

using scene::Ray;

/// A point of a mesh, in world axes.
struct PickedPoint {
    diffraction::ShadingPoint frame;  ///< as in the shaders: interpolated normal; the tangent as grating vector
    glm::dvec3 bitangent{0.0};        ///< unit
    glm::vec3 position{0.0F};
    glm::vec2 uv{0.0F};
    glm::vec2 uv1{0.0F};
    float distance = 0.0F;  ///< from the ray's origin, in lengths of its direction
};

/// Where the picture shows a point, from its upper left corner in [0, 1]; (-1, -1) behind the eye.
glm::vec2 in_picture(const scene::Camera& camera, float aspect, const glm::vec3& point);

/// The nearest point of a mesh on the ray. nullopt if the ray misses or the frame is not valid.
std::optional<PickedPoint> pick_point(const scene::Mesh& mesh, const glm::mat4& object_to_world, const Ray& ray);

/// The point's frame with its grating vector rotated toward the bitangent.
diffraction::ShadingPoint with_grating_rotated(const PickedPoint& point, double radians);

/// The direction toward the lamp in a picture whose probe is not rotated.
glm::vec3 lamp_direction(const Stage& stage);

/// The lamp's handle in the preview: a point on a sphere around the camera's target, in the direction of the lamp. The
/// sphere has the same size in the picture at all distances.
struct LampHandle {
    glm::vec2 position{0.0F};  ///< in the picture, from its upper left corner, in [0, 1]
    glm::vec2 centre{0.0F};    ///< of the sphere, likewise
    bool behind = false;       ///< on the far side of the sphere
};
LampHandle lamp_handle(const scene::Camera& camera, float aspect, const Stage& stage);

/// Moves the lamp so that its handle is at a point of the picture, on the same side of the sphere (`behind`); at the
/// rim if the point is outside. The elevation is at least 0.
void drag_lamp(Stage& stage, const scene::Camera& camera, float aspect, const glm::vec2& at, bool behind);

}  // namespace rowland::inspector
