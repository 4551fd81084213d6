#include "content/demo/pixel/surface_point.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>

#include "engine/render/gpu_mesh.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::demo {

std::optional<PlacedGrating> placed_grating(ecs::World& world, ecs::Entity grating) {
    const auto* surface = world.find<diffraction::DiffractionSurface>(grating);
    const auto* instance = world.find<render::MeshInstance>(grating);
    const auto* matrix = world.find<scene::WorldMatrix>(grating);
    if (surface == nullptr || instance == nullptr || matrix == nullptr) return std::nullopt;
    return PlacedGrating{instance->mesh, matrix->matrix, surface->groove_rotation};
}

std::optional<diffraction::ShadingPoint> frame_at(const PlacedGrating& grating, const TriangleHit& hit,
                                                  const glm::vec3& point, const glm::vec3& eye) {
    const scene::Mesh& mesh = *grating.mesh;
    const glm::mat3 linear(grating.to_world);
    const glm::vec3 normal = glm::inverseTranspose(linear) * interpolated(mesh.normals, mesh, hit);
    const glm::vec4 tangent = interpolated(mesh.tangents, mesh, hit);
    const glm::dvec3 n = glm::normalize(glm::dvec3(normal));
    glm::dvec3 t(linear * glm::vec3(tangent));
    t = glm::normalize(t - glm::dot(t, n) * n);
    // A mirroring transform inverts the handedness of the tangent frame, as in the shaders.
    const double side = static_cast<double>(tangent.w) * (glm::determinant(linear) < 0.0F ? -1.0 : 1.0);
    const glm::dvec3 b = glm::cross(n, t) * (side < 0.0 ? -1.0 : 1.0);
    const double turn = static_cast<double>(grating.groove_rotation);
    const diffraction::ShadingPoint frame{.view = glm::normalize(glm::dvec3(eye) - glm::dvec3(point)),
                                          .normal = n,
                                          .grating = std::cos(turn) * t + std::sin(turn) * b};
    if (!diffraction::is_valid(frame) || glm::dot(frame.view, frame.normal) <= 0.0) return std::nullopt;
    return frame;
}

std::string frames_csv(const diffraction::ShadingPoint& frame) {
    const auto three = [](const glm::dvec3& v) { return fmt::format("{:.17g},{:.17g},{:.17g}", v.x, v.y, v.z); };
    return fmt::format("vx,vy,vz,nx,ny,nz,gx,gy,gz\n{},{},{}\n", three(frame.view), three(frame.normal),
                       three(frame.grating));
}

}  // namespace rowland::demo
