#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"

namespace rowland::scene {

struct Ray {
    glm::vec3 origin{0.0F};
    glm::vec3 direction{0.0F, 0.0F, -1.0F};  ///< unit in world space; any length in a mesh's space
};

struct TriangleHit {
    std::size_t triangle = 0;  ///< its corners are indices 3 triangle … 3 triangle + 2 of the mesh
    glm::vec2 weights{0.0F};   ///< barycentric, of its second and third corner
    float distance = 0.0F;     ///< in lengths of the ray's direction
};

/// The ray from a camera's eye through a point of a picture. `point` counts from the upper left corner, y down, in the
/// unit of `size`.
Ray ray_through(const Camera& camera, const glm::dvec2& point, const glm::dvec2& size);

/// The intersection with one triangle, `triangle` left 0; nullopt if the ray misses (Möller & Trumbore 1997).
std::optional<TriangleHit> meet(const Ray& ray, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// The nearest hit, on either side of a triangle, at a distance of at least `nearest_allowed`; nullopt if none.
std::optional<TriangleHit> nearest_hit(const Ray& ray, const Mesh& mesh, float nearest_allowed = 0.0F);

/// Whether the ray meets the box (Kay & Kajiya 1986), enlarged a little so that rounding does not miss flat boxes.
bool meets(const Ray& ray, const Bounds& box);

/// A vertex attribute at a hit.
template <typename V>
V interpolated(const std::vector<V>& values, const Mesh& mesh, const TriangleHit& hit) {
    const std::size_t corner = 3 * hit.triangle;
    return (1.0F - hit.weights.x - hit.weights.y) * values[mesh.indices[corner]] +
           hit.weights.x * values[mesh.indices[corner + 1]] + hit.weights.y * values[mesh.indices[corner + 2]];
}

}  // namespace rowland::scene
