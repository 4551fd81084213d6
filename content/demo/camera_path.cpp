#include "content/demo/camera_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>

#include "content/demo/play/body.h"
#include "engine/core/check.h"

namespace rowland::demo {

namespace {

/// Between b and c, with the neighbours a and d [Catmull & Rom 1974].
template <typename T>
T between(const T& a, const T& b, const T& c, const T& d, float t) {
    return 0.5F * (2.0F * b + t * (c - a) + t * t * (2.0F * a - 5.0F * b + 4.0F * c - d) +
                   t * t * t * (3.0F * (b - c) + d - a));
}

}  // namespace

scene::Camera flight(const scene::Camera& start, double progress) {
    const double turn = 2.0 * std::numbers::pi * progress;
    const glm::dvec3 offset(start.eye - start.target);
    const double distance = glm::length(offset);
    const double height = std::asin(offset.y / distance);
    const double azimuth = std::atan2(offset.x, offset.z) + turn;
    // 0 at both ends, lower on one half of the way and higher on the other.
    constexpr double kLowest = 0.05;
    const double pitch = height + (height > kLowest ? height - kLowest : 0.0) * std::sin(turn);
    scene::Camera camera = start;
    camera.eye = start.target + glm::vec3(distance * glm::dvec3(std::sin(azimuth) * std::cos(pitch), std::sin(pitch),
                                                                std::cos(azimuth) * std::cos(pitch)));
    return camera;
}

scene::Camera turned(const scene::Camera& start, double progress) {
    const auto angle = static_cast<float>(2.0 * std::numbers::pi * progress);
    const glm::vec3 offset = start.eye - start.target;
    scene::Camera camera = start;
    camera.eye = start.target + glm::vec3(std::cos(angle) * offset.x + std::sin(angle) * offset.z, offset.y,
                                          std::cos(angle) * offset.z - std::sin(angle) * offset.x);
    return camera;
}

scene::Camera tour(const std::vector<scene::Camera>& views, double progress) {
    ROWLAND_CHECK(!views.empty(), "a tour needs a view");
    if (views.size() == 1) return flight(views.front(), progress);
    const auto last = static_cast<std::ptrdiff_t>(views.size()) - 1;
    const double position = std::clamp(progress, 0.0, 1.0) * static_cast<double>(last);
    const std::ptrdiff_t leg = std::min(static_cast<std::ptrdiff_t>(position), last - 1);
    const auto t = static_cast<float>(position - static_cast<double>(leg));
    const auto view = [&](std::ptrdiff_t i) -> const scene::Camera& {
        return views[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))];
    };
    const scene::Camera& from = view(leg);
    const scene::Camera& to = view(leg + 1);
    const scene::Camera& before = view(leg - 1);
    const scene::Camera& after = view(leg + 2);
    scene::Camera camera = from;
    camera.eye = between(before.eye, from.eye, to.eye, after.eye, t);
    camera.target = between(before.target, from.target, to.target, after.target, t);
    camera.vertical_field_of_view += t * (to.vertical_field_of_view - from.vertical_field_of_view);
    camera.near_plane = std::min(from.near_plane, to.near_plane);
    camera.far_plane = std::max(from.far_plane, to.far_plane);
    return camera;
}

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
