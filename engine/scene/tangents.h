#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "engine/scene/mesh.h"

namespace rowland::scene {

/// A unit vector perpendicular to the unit vector `n`; the same one every time.
glm::vec3 any_perpendicular(const glm::vec3& n);

/// Replaces the normals by the sum of the adjacent triangles' normals, each weighted by its area. A vertex without any
/// area around it gets +Y. Needs positions and indices.
void generate_normals(Mesh& mesh);

/// Replaces the tangents by the direction in which u grows, averaged over the adjacent triangles and made perpendicular
/// to the normal; w is the sign that makes cross(normal, tangent) * w point against growing v, so up in the picture, as
/// glTF's normal maps have it. Where the UVs do not say
/// (none, or degenerate), any perpendicular vector with w = 1. Needs positions, unit normals and indices; `uvs`, one a
/// vertex, are those that the mesh's normal map uses.
void generate_tangents(Mesh& mesh, std::span<const glm::vec2> uvs);
/// With the mesh's own first set of UVs.
void generate_tangents(Mesh& mesh);

/// Makes one tangent unit and perpendicular to the unit normal `n`, w = ±1. False if it has no direction of its own
/// (zero, not finite, along the normal): then it becomes any_perpendicular(n).
bool orthonormalise_tangent(glm::vec4& tangent, const glm::vec3& n);

}  // namespace rowland::scene
