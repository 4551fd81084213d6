#include "editor/inspector/pick_point.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace rowland::inspector {

Ray ray_through(const scene::Camera& camera, float aspect, const glm::vec2& at) {
    const glm::mat4 to_world = glm::inverse(camera.projection(aspect) * camera.view());
    const glm::vec4 far = to_world * glm::vec4(2.0F * at.x - 1.0F, 1.0F - 2.0F * at.y, 0.5F, 1.0F);
    return {camera.eye, glm::normalize(glm::vec3(far) / far.w - camera.eye)};
}

std::optional<diffraction::ShadingPoint> pick_point(const scene::Mesh& mesh, const glm::mat4& object_to_world,
                                                    const Ray& ray) {
    const glm::mat4 to_object = glm::inverse(object_to_world);
    const Ray local{glm::vec3(to_object * glm::vec4(ray.origin, 1.0F)), glm::mat3(to_object) * ray.direction};
    const auto hit = scene::nearest_hit(local, mesh);
    if (!hit) return std::nullopt;
    const glm::vec3 normal = scene::interpolated(mesh.normals, mesh, *hit);
    const glm::vec3 tangent(scene::interpolated(mesh.tangents, mesh, *hit));
    const glm::mat3 linear(object_to_world);
    diffraction::ShadingPoint frame{.view = -glm::dvec3(ray.direction),
                                    .normal = glm::normalize(glm::dvec3(glm::transpose(glm::inverse(linear)) * normal)),
                                    .grating = glm::normalize(glm::dvec3(linear * tangent))};
    if (!diffraction::is_valid(frame)) return std::nullopt;
    return frame;
}

}  // namespace rowland::inspector
