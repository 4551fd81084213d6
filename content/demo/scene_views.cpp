#include "content/demo/scene_views.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "content/demo/play/pick.h"

namespace rowland::demo {

namespace {

constexpr float kDefaultDistance = 1.0F;

/// Behind everything, also after the camera has moved about the scene.
float far_plane_behind(const scene::Bounds& box, const glm::vec3& eye, float near_plane) {
    const float size = glm::length(box.maximum - box.minimum);
    const float distance = glm::length(0.5F * (box.minimum + box.maximum) - eye);
    return std::max(2.0F * (distance + size), 1000.0F * near_plane);
}

scene::Camera view_of(const scene::ImportedCamera& lens, const scene::ImportedScene& scene, const scene::Mesh& merged) {
    const glm::mat4& world = scene.nodes.at(lens.node).world;
    scene::Camera camera;
    camera.eye = glm::vec3(world[3]);
    camera.vertical_field_of_view = lens.vertical_field_of_view;
    camera.near_plane = lens.near_plane;
    camera.far_plane = lens.far_plane.value_or(far_plane_behind(scene::bounds(merged), camera.eye, lens.near_plane));
    const glm::vec3 back(world[2]);
    const float length = glm::length(back);
    // A node scaled to 0 has no direction.
    const Ray ray{camera.eye, length > 0.0F && std::isfinite(length) ? -back / length : glm::vec3(0.0F, 0.0F, -1.0F)};
    const auto hit = nearest_hit(ray, merged, lens.near_plane);
    camera.target = ray.origin + (hit ? hit->distance : kDefaultDistance) * ray.direction;
    return camera;
}

}  // namespace

std::vector<scene::Camera> all_views(const scene::ImportedScene& scene, const scene::Mesh& merged) {
    std::vector<scene::Camera> views;
    for (const scene::ImportedCamera& lens : scene.cameras) views.push_back(view_of(lens, scene, merged));
    return views;
}

}  // namespace rowland::demo
