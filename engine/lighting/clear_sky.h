#pragma once

#include <glm/vec3.hpp>

#include "engine/image/image.h"

namespace rowland::lighting {

/// A cloudless sky over flat ground. Radiance is linear Rec.709 with luminance in kcd/m².
struct ClearSkyRecipe {
    double sun_azimuth_deg = 0;               ///< 0 = −Z, 90 = +X
    double sun_elevation_deg = 45;            ///< in [1, 90]
    double sun_angular_diameter_deg = 0.533;  ///< a larger disc has the same illuminance
    double turbidity = 3;                     ///< 2 very clear ... 6 hazy
    glm::dvec3 ground_albedo = {0.2, 0.2, 0.2};
};

/// Sky radiance in an upward direction, without the sun's disc: Perez' formula with the coefficients of
/// Preetham, Shirley & Smits 1999, "A practical analytic model for daylight", appendix A.2.
glm::dvec3 sky_radiance(const ClearSkyRecipe& recipe, const glm::dvec3& direction);

/// Irradiance of the sun's disc on a surface that faces it, klx: 127.5 exp(−0.21 m) with air mass m [IES RP-21 1984],
/// coloured by Rayleigh and aerosol extinction [Preetham et al. 1999, appendix A.1].
glm::dvec3 sun_irradiance(const ClearSkyRecipe& recipe);

/// Equirectangular image of `width` × `width`/2 texels: sky, ground as a diffuse reflector of sky and sun, and the
/// sun's disc, anti-aliased, of exact irradiance.
image::Image render_clear_sky(const ClearSkyRecipe& recipe, int width);

}  // namespace rowland::lighting
