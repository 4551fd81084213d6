#pragma once

#include <concepts>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/lighting/sh_light.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/model/cover.h"
#include "modules/diffraction/model/shading_point.h"
#include "modules/diffraction/representations/evaluation_light.h"
#include "modules/diffraction/representations/shading_cost.h"

namespace rowland::diffraction {

/// XYZ of one point, under a cover without T(v_n) (PHYSICS §10). May be called from many threads, except for planar
/// maps.
using PointShader = std::function<glm::dvec3(const ShadingPoint&)>;

/// The parts of a baked material that maps are filled from.
struct MaterialKernel {
    KernelTable kernel;
    double pitch_nm = 0.0;
    glm::dmat3 zero_order_xyz{0.0};  ///< ColourKernel::zero_order_xyz()
    std::optional<Cover> cover = std::nullopt;
};

/// Shades a tangent-frame view under light in the same frame.
using TangentShader = std::function<glm::dvec3(const lighting::ShLight&, const glm::dvec3& view)>;

/// Rotates the light into the tangent frame of each point and shades there. Views below the horizon are black.
PointShader in_tangent_frame(lighting::ShLight light, TangentShader shade);

/// Tables that are evaluated under the light's SH in the tangent frame.
template <typename Table>
concept HarmonicTable = requires(const Table& table, const lighting::ShLight& light, const glm::dvec3& view) {
    { table.bands } -> std::convertible_to<int>;
    { evaluate(table, light, view) } -> std::same_as<glm::dvec3>;
};

template <HarmonicTable Table>
PointShader point_shader(const Table& table, const MaterialKernel&, const EvaluationLight& light) {
    return in_tangent_frame(
        light.harmonics(table.bands),
        [table](const lighting::ShLight& rotated, const glm::dvec3& view) { return evaluate(table, rotated, view); });
}

}  // namespace rowland::diffraction
