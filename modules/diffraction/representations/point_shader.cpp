#include "modules/diffraction/representations/point_shader.h"

#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

#include "engine/math/sh_rotation.h"

namespace rowland::diffraction {

PointShader in_tangent_frame(lighting::ShLight light, TangentShader shade) {
    return [light = std::move(light), shade = std::move(shade)](const ShadingPoint& frame) {
        const glm::dmat3 tangent = world_to_tangent(frame);
        const glm::dvec3 view = tangent * glm::normalize(frame.view);
        if (view.z <= 0.0) return glm::dvec3(0.0);
        lighting::ShLight rotated{light.bands, std::vector<glm::dvec3>(light.coefficients.size())};
        math::ShRotation(tangent, light.bands)
            .apply(std::span<const glm::dvec3>(light.coefficients), std::span<glm::dvec3>(rotated.coefficients));
        return shade(rotated, view);
    };
}

}  // namespace rowland::diffraction
