#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/scene/mesh.h"

namespace rowland::scene {

/// i-th of `count` equal steps around the circle; the last is exactly the first again.
struct Angle {
    double cosine;
    double sine;
};
Angle angle(int i, int count);

/// Adds a vertex of a generated shape. In all of them v grows along cross(normal, tangent), so the tangent's w is −1.
void add_vertex(Mesh& mesh, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& tangent,
                const glm::dvec2& uv);

/// Triangulates rows of `columns` vertices each, beginning at vertex `first`. Counter-clockwise seen from where growing
/// rows point right and growing columns point up.
void add_grid(Mesh& mesh, std::uint32_t first, std::uint32_t rows, std::uint32_t columns);

}  // namespace rowland::scene
