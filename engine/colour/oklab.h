#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace rowland::colour {

/// Linear Rec.709 → the cone responses that Oklab is computed from; white is (1, 1, 1). All three are positive for
/// every spectral colour [Ottosson 2020, A perceptual color space for image processing].
glm::dmat3 rec709_to_oklab_lms();

/// The cone responses → (L, a, b): perceived lightness, white is 1; a and b are proportional to the chroma, and their
/// angle is the hue. Scaling the light by k scales L, a and b by the cube root of k. Negative responses have negative
/// roots.
glm::dvec3 oklab_of_lms(const glm::dvec3& lms);

/// The inverse of oklab_of_lms().
glm::dvec3 oklab_to_lms(const glm::dvec3& oklab);

/// The angle between the hues of two colours in degrees, 0 to 180. Neither may be neutral.
double oklab_hue_difference_deg(const glm::dvec3& oklab_1, const glm::dvec3& oklab_2);

}  // namespace rowland::colour
