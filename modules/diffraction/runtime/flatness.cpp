#include "modules/diffraction/runtime/flatness.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace rowland::diffraction {

std::optional<glm::dvec3> flat_normal(const scene::Mesh& mesh) {
    glm::dvec3 sum(0.0);
    for (const glm::vec3& normal : mesh.normals) sum += glm::dvec3(normal);
    const double length = glm::length(sum);
    if (!(length > 0.5 * static_cast<double>(mesh.normals.size()))) return std::nullopt;
    const glm::dvec3 mean = sum / length;
    for (const glm::vec3& normal : mesh.normals)
        if (glm::length(glm::cross(mean, glm::dvec3(normal))) > kFlatness || glm::dot(mean, glm::dvec3(normal)) < 0.0)
            return std::nullopt;
    return mean;
}

std::optional<glm::vec4> common_tangent(const scene::Mesh& mesh) {
    if (mesh.tangents.empty()) return std::nullopt;
    const glm::vec4& first = mesh.tangents[0];
    const bool agree = std::all_of(mesh.tangents.begin(), mesh.tangents.end(), [&](const glm::vec4& tangent) {
        return tangent.w == first.w &&
               glm::distance(glm::vec3(tangent), glm::vec3(first)) < static_cast<float>(kFlatness);
    });
    return agree ? std::optional(first) : std::nullopt;
}

}  // namespace rowland::diffraction
