#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
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

/// Something that can be pointed at.
struct PickTarget {
    ecs::Entity entity;
    std::shared_ptr<const scene::Mesh> mesh;
    scene::Bounds bounds;  ///< of the mesh
};

/// What a ray meets first in the world.
struct Hit {
    std::size_t target = 0;
    TriangleHit triangle;   ///< its distance in metres
    glm::vec3 point{0.0F};  ///< world
};

/// The nearest of the targets that are alive; nothing if the ray misses all.
std::optional<Hit> pick(ecs::World& world, std::span<const PickTarget> targets, const Ray& ray);

/// The ray through a place of a window, both in screen coordinates from the upper left, y down.
Ray ray_through(const scene::Camera& camera, glm::dvec2 place, glm::ivec2 size);

/// Object to world, from the transforms as they are now: needs no update_world_matrices().
glm::mat4 placement(ecs::World& world, ecs::Entity entity);

}  // namespace rowland::demo
