#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace rowland::scene {

/// Triangle mesh. All vertex arrays have the same length; every index is in range; all values are finite.
struct Mesh {
    std::vector<glm::vec3> positions;  ///< metres
    std::vector<glm::vec3> normals;    ///< unit
    std::vector<glm::vec4> tangents;   ///< xyz unit, perpendicular to the normal; w = ±1, sign of the UV bitangent.
                                       ///< A grating's g (across the grooves) is the tangent.
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> indices;  ///< three a triangle, counter-clockwise from outside
};

struct Bounds {
    glm::vec3 minimum{0.0F};
    glm::vec3 maximum{0.0F};
};

/// Of all positions; a point at the origin if there are none.
Bounds bounds(const Mesh& mesh);

}  // namespace rowland::scene
