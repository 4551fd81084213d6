#include "modules/diffraction/representations/direct/pattern_light.h"

#include <glm/geometric.hpp>

#include "modules/diffraction/representations/direct/lobe_table.h"

namespace rowland::diffraction {

namespace {

/// Mean of the variances of s_g and s_h.
double variance_in_plane(double along, double across, const glm::dvec3& axis) {
    return across + 0.5 * (along - across) * (axis.x * axis.x + axis.y * axis.y);
}

}  // namespace

PatternLight pattern_light(const DirectLight& light, const std::optional<Cover>& cover,
                           const glm::dmat3& world_to_tangent) {
    const LightSpot spot = light_spot(light, world_to_tangent);
    return {.irradiance = spot.cosine * transmittance(cover, spot) * light.flux,
            .centre = {spot.centre_g, spot.centre_h},
            .variance = 0.5 * (spot.deviation_g * spot.deviation_g + spot.deviation_h * spot.deviation_h)};
}

PatternLight pattern_light(const lighting::KeyLight& light, const std::optional<Cover>& cover,
                           const glm::dmat3& world_to_tangent) {
    const lighting::LobeMoments moments = lighting::lobe_moments(light.concentration);
    const glm::dvec3 axis = world_to_tangent * light.direction;
    const LightSpot spot = light_spot(light, world_to_tangent);
    return {.irradiance = lobe_height(light.concentration, axis.z) * transmittance(cover, spot) * light.flux,
            .centre = moments.mean * glm::dvec2(axis),
            .variance = variance_in_plane(moments.variance_along, moments.variance_across, axis)};
}

glm::dvec3 pattern_radiance(const PatternPicture& picture, const PatternLight& light, const glm::dvec2& v_p,
                            double footprint) {
    return picture.at(light.centre + v_p, light.variance + footprint * footprint / 3.0) * light.irradiance;
}

glm::dvec3 pattern_radiance(const PatternPicture& picture, const std::optional<Cover>& cover,
                            std::span<const lighting::KeyLight> lights, const ShadingPoint& frame) {
    const glm::dmat3 to_tangent = world_to_tangent(frame);
    const glm::dvec3 v = to_tangent * glm::normalize(frame.view);
    glm::dvec3 sum(0.0);
    if (v.z <= 0.0) return sum;
    for (const lighting::KeyLight& light : lights)
        sum += pattern_radiance(picture, pattern_light(light, cover, to_tangent), glm::dvec2(v));
    return sum;
}

}  // namespace rowland::diffraction
