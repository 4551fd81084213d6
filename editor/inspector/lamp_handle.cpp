#include "editor/inspector/lamp_handle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>

#include "editor/inspector/pick_point.h"

namespace rowland::inspector {

namespace {

constexpr float kRimHeight = 0.82F;  ///< of the sphere's rim in the picture, as a fraction of half its height

float sphere_radius(const scene::Camera& camera) {
    const float rim = std::atan(kRimHeight * std::tan(0.5F * camera.vertical_field_of_view));
    return glm::distance(camera.eye, camera.target) * std::sin(rim);
}

glm::vec2 in_picture(const scene::Camera& camera, float aspect, const glm::vec3& point) {
    const glm::vec4 clip = camera.projection(aspect) * camera.view() * glm::vec4(point, 1.0F);
    return {0.5F + 0.5F * clip.x / clip.w, 0.5F - 0.5F * clip.y / clip.w};
}

/// Where a ray meets the sphere first, or last if `far`; the point of the sphere next to it if it misses.
glm::vec3 direction_of(const Ray& ray, const glm::vec3& centre, float radius, bool far) {
    const glm::vec3 to_centre = centre - ray.origin;
    const float along = glm::dot(to_centre, ray.direction);
    const float inside = radius * radius - glm::dot(to_centre, to_centre) + along * along;
    const float half = std::sqrt(std::max(inside, 0.0F));
    return glm::normalize(ray.origin + (far ? along + half : along - half) * ray.direction - centre);
}

}  // namespace

LampHandle lamp_handle(const scene::Camera& camera, float aspect, const Stage& stage) {
    const glm::vec3 direction = lamp_direction(stage);
    const float radius = sphere_radius(camera);
    const glm::vec3 point = camera.target + radius * direction;
    return {.at = in_picture(camera, aspect, point),
            .centre = in_picture(camera, aspect, camera.target),
            .behind = glm::dot(direction, camera.eye - point) < 0.0F};
}

void drag_lamp(Stage& stage, const scene::Camera& camera, float aspect, const glm::vec2& at, bool behind) {
    const glm::vec3 direction =
        direction_of(ray_through(camera, aspect, at), camera.target, sphere_radius(camera), behind);
    stage.lamp_elevation_deg = glm::degrees(std::asin(std::clamp(direction.y, 0.0F, 1.0F)));
    // Overhead there is no azimuth: it stays.
    if (std::hypot(direction.x, direction.z) > 1e-4F)
        stage.lamp_azimuth_deg = glm::degrees(std::atan2(direction.x, direction.z));
}

}  // namespace rowland::inspector
