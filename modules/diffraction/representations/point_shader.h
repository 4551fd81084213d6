#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "engine/lighting/sh_light.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/model/shading_point.h"
#include "modules/diffraction/representations/evaluation_light.h"
#include "modules/diffraction/representations/shading_cost.h"

namespace rowland::diffraction {

/// XYZ of one frame. May be called from many threads, but for planar maps'.
using PointShader = std::function<glm::dvec3(const ShadingPoint&)>;

/// The part of a baked material that maps are filled from.
struct MaterialKernel {
    const KernelTable& kernel;
    double pitch_nm = 0.0;
    glm::dmat3 zero_order_xyz{0.0};  ///< ColourKernel::zero_order_xyz()
};

/// Shades a tangent-frame view under light in the same frame.
using TangentShader = std::function<glm::dvec3(const lighting::ShLight&, const glm::dvec3& view)>;

/// Turns the light into every frame and shades there. Views below the horizon are black.
PointShader in_tangent_frame(lighting::ShLight light, TangentShader shade);

}  // namespace rowland::diffraction
