#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

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

/// XYZ = P̄(u) · irradiance, PHYSICS (50): one look-up for all orders. `footprint`: half the extent of the pixel in u.
/// Without T(v_n).
glm::dvec3 pattern_radiance(const PatternPicture& picture, const PatternLight& light, const glm::dvec2& v_p,
                            double footprint = 0.0);

/// The part of a key light's variance that its picture's finest level is blurred by: its narrowest in the plane up to
/// 45° from the normal. The next level has the light's whole variance.
inline constexpr double kPictureVariance = 0.5;

/// A picture for each key light, of one size. `space`: of the values, from XYZ. A texture of 45 MB or less in halves.
std::vector<LightPicture> key_light_pictures(const Grating& grating, const colour::LightSpectra& spectra,
                                             std::span<const lighting::KeyLight> lights,
                                             const glm::dmat3& space = glm::dmat3(1.0));

/// XYZ of a key light from its picture: three look-ups, as it is an ellipse in the plane, PHYSICS (52). Without T(v_n).
glm::dvec3 pattern_radiance(const LightPicture& picture, const lighting::KeyLight& light,
                            const std::optional<Cover>& cover, const glm::dmat3& world_to_tangent,
                            const glm::dvec2& v_p, double footprint = 0.0);

/// The sum over a probe's key lights at a point; black for a view below the horizon.
glm::dvec3 pattern_radiance(std::span<const LightPicture> pictures, const std::optional<Cover>& cover,
                            std::span<const lighting::KeyLight> lights, const ShadingPoint& frame);

}  // namespace rowland::diffraction
