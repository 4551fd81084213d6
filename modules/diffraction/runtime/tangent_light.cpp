#include "modules/diffraction/runtime/tangent_light.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <span>

#include "engine/core/parallel.h"
#include "engine/math/sh_rotation.h"

namespace rowland::diffraction {

namespace {

constexpr std::size_t kVerticesPerTask = 256;

}  // namespace

glm::dmat3 tangent_frame(const glm::vec3& normal, const glm::vec3& tangent, const glm::mat4& object_to_world) {
    const glm::dmat3 linear(object_to_world);
    const glm::dvec3 n = glm::normalize(glm::inverseTranspose(linear) * glm::dvec3(normal));
    const glm::dvec3 along = linear * glm::dvec3(tangent);
    const glm::dvec3 g = glm::normalize(along - n * glm::dot(n, along));
    return glm::transpose(glm::dmat3(g, glm::cross(n, g), n));
}

std::vector<float> rotate_to_vertices(const lighting::ShLight& light, const scene::Mesh& mesh,
                                      const glm::mat4& object_to_world) {
    const std::size_t coefficients = light.coefficients.size();
    const std::size_t vertices = mesh.positions.size();
    std::vector<float> result(vertices * coefficients * 3);
    parallel_for((vertices + kVerticesPerTask - 1) / kVerticesPerTask, [&](std::size_t task) {
        std::vector<glm::dvec3> rotated(coefficients);
        const std::size_t end = std::min(vertices, (task + 1) * kVerticesPerTask);
        for (std::size_t vertex = task * kVerticesPerTask; vertex < end; ++vertex) {
            const glm::dmat3 frame =
                tangent_frame(mesh.normals[vertex], glm::vec3(mesh.tangents[vertex]), object_to_world);
            math::ShRotation(frame, light.bands).apply(std::span<const glm::dvec3>(light.coefficients), rotated);
            float* out = &result[vertex * coefficients * 3];
            for (const glm::dvec3& rgb : rotated)
                for (int c = 0; c < 3; ++c) *out++ = static_cast<float>(rgb[c]);
        }
    });
    return result;
}

}  // namespace rowland::diffraction
