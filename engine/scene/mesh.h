#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace rowland::scene {

/// Triangle mesh. All vertex arrays have the same length, or are empty where a comment allows it; every index is in
/// range; all values are finite.
struct Mesh {
    std::vector<glm::vec3> positions;  ///< metres
    std::vector<glm::vec3> normals;    ///< unit
    /// xyz unit, perpendicular to the normal; w = ±1: cross(normal, tangent)·w points up in the picture, against
    /// growing v.
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec2> uvs1;         ///< second set of texture coordinates; empty: none
    std::vector<glm::vec4> colours;      ///< linear RGBA that multiplies the base colour; empty: white
    std::vector<glm::u16vec4> joints;    ///< of the skin, four per vertex; empty: not skinned
    std::vector<glm::vec4> weights;      ///< of those joints, ≥ 0, sum 1; empty: not skinned
    std::vector<std::uint32_t> indices;  ///< three per triangle, counter-clockwise from outside
};

struct Bounds {
    glm::vec3 minimum{0.0F};
    glm::vec3 maximum{0.0F};
};

/// Of all positions; a point at the origin if there are none.
Bounds bounds(const Mesh& mesh);

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
