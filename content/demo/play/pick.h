#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>

#include "engine/ecs/world.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"
#include "engine/scene/ray.h"

namespace rowland::demo {

using scene::Ray;
using scene::TriangleHit;

/// A mesh that a ray can hit.
struct PickTarget {
    ecs::Entity entity;
    std::shared_ptr<const scene::Mesh> mesh;
    scene::Bounds bounds;  ///< of the mesh
};

/// The nearest intersection of a ray with the targets.
struct Hit {
    std::size_t target = 0;
    TriangleHit triangle;   ///< its distance in metres
    glm::vec3 point{0.0F};  ///< world
};

/// The nearest hit among the targets that are alive; nullopt if the ray misses all.
std::optional<Hit> pick(ecs::World& world, std::span<const PickTarget> targets, const Ray& ray);

/// The ray through a point of a window of that size; both in screen coordinates from the upper left, y down.
Ray ray_through(const scene::Camera& camera, glm::dvec2 point, glm::ivec2 size);

}  // namespace rowland::demo
