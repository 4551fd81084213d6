#include "content/demo/play/pick.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "content/demo/play/hierarchy.h"

namespace rowland::demo {

std::optional<Hit> pick(ecs::World& world, std::span<const PickTarget> targets, const Ray& ray) {
    std::optional<Hit> nearest;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        if (!world.alive(targets[i].entity)) continue;
        const glm::mat4 to_world = object_to_world(world, targets[i].entity);
        if (glm::determinant(to_world) == 0.0F) continue;
        const glm::mat4 to_mesh = glm::inverse(to_world);
        // The direction keeps its length in the mesh's space, so that distances stay metres.
        const Ray local{glm::vec3(to_mesh * glm::vec4(ray.origin, 1.0F)), glm::mat3(to_mesh) * ray.direction};
        if (!scene::meets(local, targets[i].bounds)) continue;
        const auto hit = nearest_hit(local, *targets[i].mesh);
        if (!hit || (nearest && hit->distance >= nearest->triangle.distance)) continue;
        nearest = {.target = i, .triangle = *hit, .point = ray.origin + hit->distance * ray.direction};
    }
    return nearest;
}

Ray ray_through(const scene::Camera& camera, glm::dvec2 point, glm::ivec2 size) {
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::vec3 up = glm::cross(right, forward);
    // The window's height is 2 tan(fov / 2) at distance 1.
    const double scale = 2.0 * std::tan(0.5 * static_cast<double>(camera.vertical_field_of_view)) / size.y;
    const auto x = static_cast<float>(scale * (point.x - 0.5 * size.x));
    const auto y = static_cast<float>(scale * (0.5 * size.y - point.y));
    return {camera.eye, glm::normalize(forward + x * right + y * up)};
}

}  // namespace rowland::demo
