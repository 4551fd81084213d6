#include "engine/scene/ray.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace rowland::scene {

Ray ray_through(const scene::Camera& camera, const glm::dvec2& point, const glm::dvec2& size) {
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::vec3 up = glm::cross(right, forward);
    // The picture's height is 2 tan(fov / 2) at distance 1.
    const double scale = 2.0 * std::tan(0.5 * static_cast<double>(camera.vertical_field_of_view)) / size.y;
    const auto x = static_cast<float>(scale * (point.x - 0.5 * size.x));
    const auto y = static_cast<float>(scale * (0.5 * size.y - point.y));
    return {camera.eye, glm::normalize(forward + x * right + y * up)};
}

std::optional<TriangleHit> meet(const Ray& ray, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 ab = b - a;
    const glm::vec3 ac = c - a;
    const glm::vec3 across = glm::cross(ray.direction, ac);
    const float determinant = glm::dot(ab, across);
    if (determinant == 0.0F) return std::nullopt;
    const glm::vec3 from_a = ray.origin - a;
    const float u = glm::dot(from_a, across) / determinant;
    const glm::vec3 normal = glm::cross(from_a, ab);
    const float v = glm::dot(ray.direction, normal) / determinant;
    const float distance = glm::dot(ac, normal) / determinant;
    if (!(u >= 0.0F && v >= 0.0F && u + v <= 1.0F && distance > 0.0F)) return std::nullopt;
    return TriangleHit{.triangle = 0, .weights = {u, v}, .distance = distance};
}

std::optional<TriangleHit> nearest_hit(const Ray& ray, const Mesh& mesh, float nearest_allowed) {
    std::optional<TriangleHit> nearest;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        auto hit = meet(ray, mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                        mesh.positions[mesh.indices[i + 2]]);
        if (!hit || hit->distance < nearest_allowed || (nearest && hit->distance >= nearest->distance)) continue;
        hit->triangle = i / 3;
        nearest = hit;
    }
    return nearest;
}

bool meets(const Ray& ray, const Bounds& box) {
    const glm::vec3 margin = 1e-4F * (box.maximum - box.minimum) + 1e-6F;
    float enter = 0.0F;
    float leave = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const float low = box.minimum[axis] - margin[axis] - ray.origin[axis];
        const float high = box.maximum[axis] + margin[axis] - ray.origin[axis];
        if (ray.direction[axis] == 0.0F) {
            if (low > 0.0F || high < 0.0F) return false;
            continue;
        }
        const float to_low = low / ray.direction[axis];
        const float to_high = high / ray.direction[axis];
        enter = std::max(enter, std::min(to_low, to_high));
        leave = std::min(leave, std::max(to_low, to_high));
    }
    return enter <= leave;
}

}  // namespace rowland::scene
