#pragma once

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace rowland::colour {

/// CIE 1931 xy of an RGB space.
struct Primaries {
    glm::dvec2 red;
    glm::dvec2 green;
    glm::dvec2 blue;
    glm::dvec2 white;
};

/// ITU-R BT.709 with D65.
inline constexpr Primaries kRec709{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

/// XYZ of luminance 1 of a chromaticity xy.
glm::dvec3 xy_to_xyz(const glm::dvec2& xy);

/// Linear RGB → XYZ: each primary scaled so that (1,1,1) is `white`. p.white is not read.
glm::dmat3 rgb_to_xyz(const Primaries& p, const glm::dvec3& white);

/// Chromatic adaptation of XYZ from one white to another by scaling in Bradford's cone space [Lam 1985; ICC.1, annex
/// E].
glm::dmat3 bradford(const glm::dvec3& from_white, const glm::dvec3& to_white);

/// Linear RGB of `from` → linear Rec.709, adapted by bradford(); nullopt if the two spaces agree to 1e-3 in xy, or if
/// `from` is not usable.
std::optional<glm::dmat3> to_rec709(const Primaries& from);

/// CIE 1931 XYZ → linear Rec.709 without adaptation: kRec709.white of luminance 1 becomes (1,1,1). The inverse of
/// rec709_to_xyz() to about four digits only, since that has white_d65().
glm::dmat3 xyz_to_rec709();

/// Whether the primaries span a triangle and the white point has luminance.
bool is_usable(const Primaries& primaries);

/// Luminance of linear Rec.709, to four digits.
inline double luminance(const glm::dvec3& rgb) {
    return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
}

/// D65's white as the tables give it: XYZ of spectral rgb (1,1,1), Y = 1. Chromaticity (0.3127, 0.3290) to four digits.
/// rec709_to_xyz() and xyz_to_acescg() use it, so that they keep white neutral to rounding.
glm::dvec3 white_d65();

/// Linear Rec.709 → XYZ (ITU-R BT.709 primaries, white_d65()).
glm::dmat3 rec709_to_xyz();

/// XYZ → ACEScg: Bradford adaptation from white_d65() to ACES' D60 (0.32168, 0.33767), then the AP1 primaries
/// (SMPTE ST 2065-1, S-2014-004). Does not clip.
glm::dmat3 xyz_to_acescg();

// sRGB's curve between a linear component and its encoded value, both in [0, 1]: IEC 61966-2-1.

inline double srgb_encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

inline double srgb_linear(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Linear Rec.709 → the cone responses that Oklab is computed from; white is (1, 1, 1). All three are positive for
/// every spectral colour [Ottosson 2020, A perceptual color space for image processing].
glm::dmat3 rec709_to_oklab_lms();

/// The cone responses → Oklab (L, a, b): L is the perceived lightness, 1 for white, the length of (a, b) the chroma and
/// its angle the hue. Scaling the light by k scales L, a and b by the cube root of k. Negative responses have negative
/// roots.
glm::dvec3 oklab_of_lms(const glm::dvec3& lms);

/// The inverse of oklab_of_lms().
glm::dvec3 oklab_to_lms(const glm::dvec3& oklab);

/// The angle between the hues of two colours in degrees, 0 to 180. Neither may be neutral.
double oklab_hue_difference_deg(const glm::dvec3& oklab_1, const glm::dvec3& oklab_2);

}  // namespace rowland::colour
