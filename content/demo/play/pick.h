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

namespace rowland::demo {

struct Ray {
    glm::vec3 origin{0.0F};
    glm::vec3 direction{0.0F, 0.0F, -1.0F};  ///< unit, or what it became in a mesh's space
};

/// Where a ray meets a triangle.
struct TriangleHit {
    std::size_t triangle = 0;  ///< its corners are indices 3 triangle … 3 triangle + 2 of the mesh
    glm::vec2 weights{0.0F};   ///< of its second and third corner; the first has the rest
    float distance = 0.0F;     ///< in lengths of the ray's direction
};

/// Where a ray meets one triangle, its number left 0; nothing if it misses (Möller & Trumbore 1997).
std::optional<TriangleHit> meet(const Ray& ray, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// The nearest triangle, seen from either side and at least `nearest_allowed` away (Möller & Trumbore 1997); nothing if
/// the ray misses.
std::optional<TriangleHit> nearest_hit(const Ray& ray, const scene::Mesh& mesh, float nearest_allowed = 0.0F);

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
