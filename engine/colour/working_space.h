#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace rowland::colour {

/// Luminance of linear Rec.709, to four digits.
inline double luminance(const glm::dvec3& rgb) {
    return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
}

/// D65's white as the tables give it: XYZ of spectral rgb (1,1,1), Y = 1. Chromaticity (0.3127, 0.3290) to four digits.
/// All matrices below use it, so white stays neutral to rounding.
glm::dvec3 white_d65();

/// Linear Rec.709 → XYZ (ITU-R BT.709 primaries, white_d65()).
glm::dmat3 rec709_to_xyz();

/// XYZ → ACEScg: Bradford adaptation from white_d65() to ACES' D60 (0.32168, 0.33767), then the AP1 primaries
/// (SMPTE ST 2065-1, S-2014-004). Does not clip.
glm::dmat3 xyz_to_acescg();

}  // namespace rowland::colour
