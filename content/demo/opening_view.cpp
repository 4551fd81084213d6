#include "content/demo/opening_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <optional>

#include "engine/core/check.h"

namespace rowland::demo {

namespace {

constexpr float kUsualDistance = 1.0F;

struct Ray {
    glm::vec3 origin;
    glm::vec3 direction;  ///< unit
};

/// How far along the ray a triangle is (Möller & Trumbore 1997), seen from either side.
std::optional<float> distance_to(const Ray& ray, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
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
    return distance;
}

std::optional<float> nearest_hit(const Ray& ray, const scene::Mesh& mesh, float nearest_allowed) {
    std::optional<float> nearest;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const auto hit = distance_to(ray, mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                                     mesh.positions[mesh.indices[i + 2]]);
        if (hit && *hit >= nearest_allowed && (!nearest || *hit < *nearest)) nearest = hit;
    }
    return nearest;
}

/// Beyond everything, wherever the camera goes near the scene.
float far_plane_behind(const scene::Bounds& box, const glm::vec3& eye, float near_plane) {
    const float size = glm::length(box.maximum - box.minimum);
    const float distance = glm::length(0.5F * (box.minimum + box.maximum) - eye);
    return std::max(2.0F * (distance + size), 1000.0F * near_plane);
}

}  // namespace

scene::Camera opening_view(const scene::ImportedScene& scene, const scene::Mesh& merged) {
    ROWLAND_CHECK(!scene.cameras.empty(), "the scene needs a camera");
    const scene::ImportedCamera& lens = scene.cameras.front();
    const glm::mat4& world = scene.nodes.at(lens.node).world;
    scene::Camera camera;
    camera.eye = glm::vec3(world[3]);
    camera.vertical_field_of_view = lens.vertical_field_of_view;
    camera.near_plane = lens.near_plane;
    camera.far_plane = lens.far_plane.value_or(far_plane_behind(scene::bounds(merged), camera.eye, lens.near_plane));
    const glm::vec3 back(world[2]);
    const float length = glm::length(back);
    // A node scaled to nothing looks nowhere.
    const Ray ray{camera.eye, length > 0.0F && std::isfinite(length) ? -back / length : glm::vec3(0.0F, 0.0F, -1.0F)};
    camera.target = ray.origin + nearest_hit(ray, merged, lens.near_plane).value_or(kUsualDistance) * ray.direction;
    return camera;
}

}  // namespace rowland::demo
