#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "engine/image/image.h"

namespace rowland::lighting {

/// Unit vector at an azimuth (0 = −Z, growing toward +X) and an elevation above the horizon, in radians.
inline glm::dvec3 direction_at(double azimuth, double elevation) {
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), -std::cos(elevation) * std::cos(azimuth)};
}

/// Direction of the image point (x, y), in texels, of an equirectangular image of `width` × `width`/2 texels
/// (PHYSICS §1 of modules/diffraction).
inline glm::dvec3 equirectangular_direction(double x, double y, int width) {
    const double azimuth = 2 * std::numbers::pi * (x / width - 0.5);
    const double elevation = std::numbers::pi * (0.5 - 2 * y / width);
    return direction_at(azimuth, elevation);
}

/// A cloudless sky over flat ground. Radiance is linear Rec.709 with luminance in kcd/m².
struct ClearSkyRecipe {
    double sun_azimuth_deg = 0;               ///< 0 = −Z, 90 = +X
    double sun_elevation_deg = 45;            ///< in [1, 90]
    double sun_angular_diameter_deg = 0.533;  ///< a larger one lowers the radiance; the illuminance stays
    double turbidity = 3;                     ///< 2 very clear ... 6 hazy
    glm::dvec3 ground_albedo = {0.2, 0.2, 0.2};
};

/// Sky radiance from a direction above the horizon, without the sun's disc: Perez' formula with the coefficients of
/// Preetham, Shirley & Smits 1999, "A practical analytic model for daylight", appendix A.2.
glm::dvec3 sky_radiance(const ClearSkyRecipe& recipe, const glm::dvec3& direction);

/// RGB irradiance of the sun's disc on a surface that faces it; its luminance is the illuminance in klx, 127.5
/// exp(−0.21 m) with air mass m [IES RP-21 1984], coloured by Rayleigh and aerosol extinction [Preetham et al. 1999,
/// appendix A.1].
glm::dvec3 sun_irradiance(const ClearSkyRecipe& recipe);

/// Equirectangular image of `width` × `width`/2 texels, `width` a multiple of 4: the sky, the ground as a diffuse
/// reflector of sky and sun, and the sun's anti-aliased disc, scaled to the exact irradiance.
image::Image render_clear_sky(const ClearSkyRecipe& recipe, int width);

/// A rectangular light, given by the angles under which the object sees it.
struct SoftBox {
    double azimuth_deg = 0;     ///< 0 = −Z, 90 = +X
    double elevation_deg = 0;   ///< of its centre above the horizon
    double roll_deg = 0;        ///< rotated about its centre, counter-clockwise as the object sees it
    double half_width_deg = 0;  ///< in (0, 80]
    double half_height_deg = 0;
    double soft_edge_deg = 0;  ///< angular width of the fade inside its edge
    glm::dvec3 radiance = {};
};

/// A dark room with soft boxes, on a relative radiance scale, linear Rec.709.
struct StudioRecipe {
    glm::dvec3 ceiling = {};  ///< radiance from the zenith; blends to `wall` at the horizon
    glm::dvec3 wall = {};
    glm::dvec3 floor = {};  ///< radiance from the nadir; blends likewise
    std::vector<SoftBox> boxes;
};

/// Equirectangular image of `width` × `width`/2 texels, each of which averages 4 × 4 samples.
image::Image render_studio(const StudioRecipe& recipe, int width);

}  // namespace rowland::lighting
