#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "engine/scene/mesh.h"

namespace rowland::scene {

/// A unit vector perpendicular to the unit vector `n`, always the same for the same `n`.
glm::vec3 any_perpendicular(const glm::vec3& n);

/// Replaces the normals by the sum of the adjacent triangles' normals, each weighted by its area. A vertex without
/// adjacent area gets +Y. Needs positions and indices.
void generate_normals(Mesh& mesh);

/// Replaces the tangents by the direction in which u grows, averaged over the adjacent triangles and perpendicular to
/// the normal. The sign w makes cross(normal, tangent) * w point against growing v, up in the picture, as in glTF's
/// normal maps. Where the UVs give no direction (none, or degenerate): any perpendicular vector with w = 1. Needs
/// positions, unit normals and indices; `uvs`, one per vertex, are those of the mesh's normal map.
void generate_tangents(Mesh& mesh, std::span<const glm::vec2> uvs);
/// The same with the mesh's first set of UVs.
void generate_tangents(Mesh& mesh);

/// Makes one tangent unit and perpendicular to the unit normal `n`, w = ±1. False if it has no usable direction (zero,
/// not finite, along the normal): then it becomes any_perpendicular(n).
bool orthonormalise_tangent(glm::vec4& tangent, const glm::vec3& n);

/// Transforms one vertex's position, normal and tangent by an affine matrix, which may mirror. A normal that the matrix
/// leaves without a direction stays as it was.
void transform_vertex(Mesh& mesh, std::size_t vertex, const glm::mat4& matrix);

}  // namespace rowland::scene
