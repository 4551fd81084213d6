#include "engine/scene/mesh.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rowland::scene {

Bounds bounds(const Mesh& mesh) {
    if (mesh.positions.empty()) return {};
    Bounds box{mesh.positions.front(), mesh.positions.front()};
    for (const glm::vec3& position : mesh.positions) {
        box.minimum = glm::min(box.minimum, position);
        box.maximum = glm::max(box.maximum, position);
    }
    return box;
}

namespace {

// Sums are in double: the area of a small triangle far from the origin is a difference of large floats.
struct Sum {
    glm::dvec3 u{0.0};
    glm::dvec3 v{0.0};
};

/// Adds the triangle's dP/du and dP/dv, weighted by the magnitude of its area in UV space. The weight cancels the
/// division by that area, which may be tiny.
void add_uv_gradient(const Mesh& mesh, std::span<const glm::vec2> uvs, std::size_t first_index,
                     std::vector<Sum>& sums) {
    const std::uint32_t* corner = &mesh.indices[first_index];
    const glm::dvec3 p0(mesh.positions[corner[0]]);
    const glm::dvec3 e1 = glm::dvec3(mesh.positions[corner[1]]) - p0;
    const glm::dvec3 e2 = glm::dvec3(mesh.positions[corner[2]]) - p0;
    const glm::dvec2 uv0(uvs[corner[0]]);
    const glm::dvec2 d1 = glm::dvec2(uvs[corner[1]]) - uv0;
    const glm::dvec2 d2 = glm::dvec2(uvs[corner[2]]) - uv0;
    const double area = d1.x * d2.y - d2.x * d1.y;
    if (area == 0.0 || !std::isfinite(area)) return;
    const double sign = area > 0.0 ? 1.0 : -1.0;
    const glm::dvec3 along_u = sign * (d2.y * e1 - d1.y * e2);
    const glm::dvec3 along_v = sign * (d1.x * e2 - d2.x * e1);
    for (int i = 0; i < 3; ++i) {
        sums[corner[i]].u += along_u;
        sums[corner[i]].v += along_v;
    }
}

/// The part of `x` perpendicular to `n`, unit; zero if that is not well defined.
glm::dvec3 perpendicular_part(const glm::dvec3& x, const glm::dvec3& n) {
    const double length = glm::length(x);
    if (!(length > 0.0) || !std::isfinite(length)) return glm::dvec3(0.0);
    const glm::dvec3 direction = x / length;
    const glm::dvec3 part = direction - glm::dot(direction, n) * n;
    const double part_length = glm::length(part);
    // Within 0.06 degrees of the normal the remainder is rounding error, not direction.
    return part_length > 1e-3 ? part / part_length : glm::dvec3(0.0);
}

}  // namespace

glm::vec3 any_perpendicular(const glm::vec3& n) {
    const glm::vec3 size = glm::abs(n);
    glm::vec3 axis(0.0F);
    if (size.x <= size.y && size.x <= size.z)
        axis.x = 1.0F;
    else if (size.z <= size.y)
        axis.z = 1.0F;
    else
        axis.y = 1.0F;
    return glm::normalize(axis - glm::dot(axis, n) * n);
}

void generate_normals(Mesh& mesh) {
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* corner = &mesh.indices[i];
        const glm::dvec3 p0(mesh.positions[corner[0]]);
        // The cross product's length is twice the area, which is the weight.
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(mesh.positions[corner[1]]) - p0, glm::dvec3(mesh.positions[corner[2]]) - p0);
        for (int k = 0; k < 3; ++k) sums[corner[k]] += normal;
    }
    mesh.normals.resize(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double length = glm::length(sums[i]);
        mesh.normals[i] =
            length > 0.0 && std::isfinite(length) ? glm::vec3(sums[i] / length) : glm::vec3(0.0F, 1.0F, 0.0F);
    }
}

void generate_tangents(Mesh& mesh) {
    generate_tangents(mesh, mesh.uvs);
}

void generate_tangents(Mesh& mesh, std::span<const glm::vec2> uvs) {
    std::vector<Sum> sums(mesh.positions.size());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) add_uv_gradient(mesh, uvs, i, sums);
    mesh.tangents.resize(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const glm::dvec3 n(mesh.normals[i]);
        const glm::dvec3 tangent = perpendicular_part(sums[i].u, n);
        if (tangent == glm::dvec3(0.0)) {
            mesh.tangents[i] = glm::vec4(any_perpendicular(mesh.normals[i]), 1.0F);
        } else {
            const float w = glm::dot(glm::cross(n, tangent), sums[i].v) > 0.0 ? -1.0F : 1.0F;
            mesh.tangents[i] = glm::vec4(glm::vec3(tangent), w);
        }
    }
}

bool orthonormalise_tangent(glm::vec4& tangent, const glm::vec3& n) {
    const float w = tangent.w < 0.0F ? -1.0F : 1.0F;
    const glm::dvec3 part = perpendicular_part(glm::dvec3(glm::vec3(tangent)), glm::dvec3(n));
    const bool usable = part != glm::dvec3(0.0);
    tangent = glm::vec4(usable ? glm::vec3(part) : any_perpendicular(n), w);
    return usable;
}

void transform_vertex(Mesh& mesh, std::size_t vertex, const glm::mat4& matrix) {
    const glm::dmat4 affine(matrix);
    const glm::dmat3 linear(affine);
    // The cofactors are det times the inverse transpose, and exist for every matrix. Normals must not
    // take the sign of det.
    const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                               glm::cross(linear[0], linear[1]));
    const double side = glm::dot(cofactors[2], linear[2]) < 0.0 ? -1.0 : 1.0;
    mesh.positions[vertex] = glm::vec3(affine * glm::dvec4(glm::dvec3(mesh.positions[vertex]), 1.0));
    const glm::dvec3 normal = side * (cofactors * glm::dvec3(mesh.normals[vertex]));
    const double length = glm::length(normal);
    if (length > 0.0 && std::isfinite(length)) mesh.normals[vertex] = glm::vec3(normal / length);
    glm::vec4& tangent = mesh.tangents[vertex];
    const glm::dvec3 transformed = linear * glm::dvec3(glm::vec3(tangent));
    const double size = glm::length(transformed);
    tangent = glm::vec4(size > 0.0 ? transformed / size : transformed, side * tangent.w);
    orthonormalise_tangent(tangent, mesh.normals[vertex]);
}

}  // namespace rowland::scene
