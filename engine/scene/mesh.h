#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace rowland::scene {

/// Triangle mesh. All vertex arrays have the same length, or are empty where it says so; every index is in range; all
/// values are finite.
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

}  // namespace rowland::scene
