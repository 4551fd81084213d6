#include "editor/inspector/pick_point.h"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace rowland::inspector {

namespace {

/// Where a ray meets a triangle: distance and the weights of the second and third corner (Möller & Trumbore 1997).
std::optional<glm::vec3> meet(const Ray& ray, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 ab = b - a;
    const glm::vec3 ac = c - a;
    const glm::vec3 p = glm::cross(ray.direction, ac);
    const float determinant = glm::dot(ab, p);
    if (determinant == 0.0F) return std::nullopt;
    const glm::vec3 from = ray.origin - a;
    const float u = glm::dot(from, p) / determinant;
    const glm::vec3 q = glm::cross(from, ab);
    const float v = glm::dot(ray.direction, q) / determinant;
    const float distance = glm::dot(ac, q) / determinant;
    if (!(u >= 0.0F && v >= 0.0F && u + v <= 1.0F && distance > 0.0F)) return std::nullopt;
    return glm::vec3(distance, u, v);
}

}  // namespace

Ray ray_through(const scene::Camera& camera, float aspect, const glm::vec2& at) {
    const glm::mat4 to_world = glm::inverse(camera.projection(aspect) * camera.view());
    const glm::vec4 far = to_world * glm::vec4(2.0F * at.x - 1.0F, 1.0F - 2.0F * at.y, 0.5F, 1.0F);
    return {camera.eye, glm::normalize(glm::vec3(far) / far.w - camera.eye)};
}

std::optional<diffraction::Frame> pick_point(const scene::Mesh& mesh, const glm::mat4& object_to_world,
                                             const Ray& ray) {
    const glm::mat4 to_object = glm::inverse(object_to_world);
    const Ray local{glm::vec3(to_object * glm::vec4(ray.origin, 1.0F)), glm::mat3(to_object) * ray.direction};
    float nearest = std::numeric_limits<float>::infinity();
    glm::vec3 normal(0.0F);
    glm::vec3 tangent(0.0F);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i];
        const std::uint32_t b = mesh.indices[i + 1];
        const std::uint32_t c = mesh.indices[i + 2];
        const auto hit = meet(local, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
        if (!hit || hit->x >= nearest) continue;
        nearest = hit->x;
        const auto mix = [&](const auto& values) {
            return (1.0F - hit->y - hit->z) * glm::vec3(values[a]) + hit->y * glm::vec3(values[b]) +
                   hit->z * glm::vec3(values[c]);
        };
        normal = mix(mesh.normals);
        tangent = mix(mesh.tangents);
    }
    if (!std::isfinite(nearest)) return std::nullopt;
    const glm::mat3 turn(object_to_world);
    diffraction::Frame frame{.view = -glm::dvec3(ray.direction),
                             .normal = glm::normalize(glm::dvec3(glm::transpose(glm::inverse(turn)) * normal)),
                             .grating = glm::normalize(glm::dvec3(turn * tangent))};
    if (!diffraction::is_valid(frame)) return std::nullopt;
    return frame;
}

}  // namespace rowland::inspector
