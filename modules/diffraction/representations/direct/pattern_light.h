#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "modules/diffraction/bake/pattern_picture.h"
#include "modules/diffraction/representations/direct/direct.h"

namespace rowland::diffraction {

/// A light as a lattice sees it: its flux on the surface, and where it lies in the plane of the surface.
struct PatternLight {
    glm::dvec3 irradiance{0.0};  ///< flux times the mean of s_n⁺, and a cover's T(s_n)
    glm::dvec2 centre{0.0};      ///< mean of (s_g, s_h)
    double variance = 0.0;       ///< of s_g and s_h, their mean
};
PatternLight pattern_light(const DirectLight& light, const std::optional<Cover>& cover,
                           const glm::dmat3& world_to_tangent);
PatternLight pattern_light(const lighting::KeyLight& light, const std::optional<Cover>& cover,
                           const glm::dmat3& world_to_tangent);

/// XYZ = P̄(u) · irradiance, PHYSICS (50): one look-up for all orders. `footprint`: half the extent of the pixel in u.
/// Without T(v_n).
glm::dvec3 pattern_radiance(const PatternPicture& picture, const PatternLight& light, const glm::dvec2& v_p,
                            double footprint = 0.0);

/// The sum over a probe's key lights at a point; black for a view below the horizon.
glm::dvec3 pattern_radiance(const PatternPicture& picture, const std::optional<Cover>& cover,
                            std::span<const lighting::KeyLight> lights, const ShadingPoint& frame);

}  // namespace rowland::diffraction
