#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/scene/mesh.h"

namespace rowland::scene {

/// The i-th of `count` equal steps around the circle; step `count` equals step 0 exactly.
struct Angle {
    double cosine;
    double sine;
};
Angle angle(int i, int count);

/// Adds a vertex of a generated shape. In all of them v grows along cross(normal, tangent), so the tangent's w is −1.
void add_vertex(Mesh& mesh, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& tangent,
                const glm::dvec2& uv);

/// Triangulates a grid of vertices, row by row from vertex `first`. Counter-clockwise where the row index grows to the
/// right and the column index upwards.
void add_grid(Mesh& mesh, std::uint32_t first, std::uint32_t rows, std::uint32_t columns);

}  // namespace rowland::scene
