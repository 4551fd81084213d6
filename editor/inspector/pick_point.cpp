#include "editor/inspector/pick_point.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace rowland::inspector {

namespace {

constexpr float kRimHeight = 0.82F;  ///< radius of the sphere's rim, as a fraction of half the picture's height

float sphere_radius(const scene::Camera& camera) {
    const float rim = std::atan(kRimHeight * std::tan(0.5F * camera.vertical_field_of_view));
    return glm::distance(camera.eye, camera.target) * std::sin(rim);
}

/// The direction from the centre of a sphere to its first intersection with a ray (the last if `far`), or to its point
/// nearest to a ray that misses.
glm::vec3 direction_of(const Ray& ray, const glm::vec3& centre, float radius, bool far) {
    const glm::vec3 to_centre = centre - ray.origin;
    const float along = glm::dot(to_centre, ray.direction);
    const float inside = radius * radius - glm::dot(to_centre, to_centre) + along * along;
    const float half = std::sqrt(std::max(inside, 0.0F));
    return glm::normalize(ray.origin + (far ? along + half : along - half) * ray.direction - centre);
}

}  // namespace

glm::vec2 in_picture(const scene::Camera& camera, float aspect, const glm::vec3& point) {
    const glm::vec4 clip = camera.projection(aspect) * camera.view() * glm::vec4(point, 1.0F);
    if (clip.w <= 0.0F) return glm::vec2(-1.0F);
    return {0.5F + 0.5F * clip.x / clip.w, 0.5F - 0.5F * clip.y / clip.w};
}

std::optional<PickedPoint> pick_point(const scene::Mesh& mesh, const glm::mat4& object_to_world, const Ray& ray) {
    const glm::mat3 linear(object_to_world);
    const float determinant = glm::determinant(linear);
    if (determinant == 0.0F) return std::nullopt;
    const glm::mat4 to_object = glm::inverse(object_to_world);
    // The direction is not normalised in the mesh's space, so that distances along it are those of the world.
    const Ray local{glm::vec3(to_object * glm::vec4(ray.origin, 1.0F)), glm::mat3(to_object) * ray.direction};
    const auto hit = scene::nearest_hit(local, mesh);
    if (!hit) return std::nullopt;
    const glm::vec3 normal = scene::interpolated(mesh.normals, mesh, *hit);
    const glm::vec4 tangent = scene::interpolated(mesh.tangents, mesh, *hit);
    PickedPoint point{.frame = {.view = -glm::dvec3(ray.direction),
                                .normal = glm::normalize(glm::dvec3(glm::transpose(glm::inverse(linear)) * normal)),
                                .grating = glm::normalize(glm::dvec3(linear * glm::vec3(tangent)))},
                      .position = ray.origin + hit->distance * ray.direction,
                      .distance = hit->distance};
    if (!diffraction::is_valid(point.frame)) return std::nullopt;
    const double side = (tangent.w < 0.0F) == (determinant < 0.0F) ? 1.0 : -1.0;
    point.bitangent = side * glm::normalize(glm::cross(point.frame.normal, point.frame.grating));
    if (!mesh.uvs.empty()) point.uv = scene::interpolated(mesh.uvs, mesh, *hit);
    if (!mesh.uvs1.empty()) point.uv1 = scene::interpolated(mesh.uvs1, mesh, *hit);
    return point;
}

diffraction::ShadingPoint with_grating_rotated(const PickedPoint& point, double radians) {
    diffraction::ShadingPoint frame = point.frame;
    frame.grating = std::cos(radians) * point.frame.grating + std::sin(radians) * point.bitangent;
    return frame;
}

glm::vec3 lamp_direction(const Stage& stage) {
    const float azimuth = glm::radians(stage.lamp_azimuth_deg);
    const float elevation = glm::radians(stage.lamp_elevation_deg);
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

LampHandle lamp_handle(const scene::Camera& camera, float aspect, const Stage& stage) {
    const glm::vec3 direction = lamp_direction(stage);
    const float radius = sphere_radius(camera);
    const glm::vec3 point = camera.target + radius * direction;
    return {.position = in_picture(camera, aspect, point),
            .centre = in_picture(camera, aspect, camera.target),
            .behind = glm::dot(direction, camera.eye - point) < 0.0F};
}

void drag_lamp(Stage& stage, const scene::Camera& camera, float aspect, const glm::vec2& at, bool behind) {
    const Ray ray = scene::ray_through(camera, {aspect * at.x, at.y}, {aspect, 1.0F});
    const glm::vec3 direction = direction_of(ray, camera.target, sphere_radius(camera), behind);
    stage.lamp_elevation_deg = glm::degrees(std::asin(std::clamp(direction.y, 0.0F, 1.0F)));
    // A lamp overhead has no azimuth, so the last one stays.
    if (std::hypot(direction.x, direction.z) > 1e-4F)
        stage.lamp_azimuth_deg = glm::degrees(std::atan2(direction.x, direction.z));
}

}  // namespace rowland::inspector
