#include "editor/inspector/pick_point.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace rowland::inspector {

Ray ray_through(const scene::Camera& camera, float aspect, const glm::vec2& at) {
    const glm::mat4 to_world = glm::inverse(camera.projection(aspect) * camera.view());
    const glm::vec4 far = to_world * glm::vec4(2.0F * at.x - 1.0F, 1.0F - 2.0F * at.y, 0.5F, 1.0F);
    return {camera.eye, glm::normalize(glm::vec3(far) / far.w - camera.eye)};
}

std::optional<PickedPoint> pick_point(const scene::Mesh& mesh, const glm::mat4& object_to_world, const Ray& ray) {
    const glm::mat3 linear(object_to_world);
    const float determinant = glm::determinant(linear);
    if (determinant == 0.0F) return std::nullopt;
    const glm::mat4 to_object = glm::inverse(object_to_world);
    // The direction keeps its length in the mesh's space, so that distances are those of the world.
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

diffraction::ShadingPoint turned(const PickedPoint& point, double radians) {
    diffraction::ShadingPoint frame = point.frame;
    frame.grating = std::cos(radians) * point.frame.grating + std::sin(radians) * point.bitangent;
    return frame;
}

}  // namespace rowland::inspector
