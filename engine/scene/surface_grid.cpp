#include "engine/scene/surface_grid.h"

#include <cmath>
#include <numbers>

namespace rowland::scene {

Angle angle(int i, int count) {
    const double radians = 2.0 * std::numbers::pi * (i % count) / count;
    return {std::cos(radians), std::sin(radians)};
}

void add_vertex(Mesh& mesh, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& tangent,
                const glm::dvec2& uv) {
    mesh.positions.emplace_back(position);
    mesh.normals.emplace_back(normal);
    mesh.tangents.emplace_back(glm::vec3(tangent), -1.0F);
    mesh.uvs.emplace_back(uv);
}

void add_grid(Mesh& mesh, std::uint32_t first, std::uint32_t rows, std::uint32_t columns) {
    for (std::uint32_t row = 0; row + 1 < rows; ++row) {
        for (std::uint32_t column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = first + row * columns + column;
            const std::uint32_t b = a + columns;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    }
}

}  // namespace rowland::scene
