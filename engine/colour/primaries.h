#pragma once

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

/// Chromatic adaptation of XYZ from one white to another by scaling in Bradford's cone space (Lam 1985; ICC.1, annex
/// E).
glm::dmat3 bradford(const glm::dvec3& from_white, const glm::dvec3& to_white);

/// Linear RGB of `from` → linear Rec.709, adapted by bradford(); nullopt if the two spaces agree to 1e-3 in xy, or if
/// `from` is not usable.
std::optional<glm::dmat3> to_rec709(const Primaries& from);

/// CIE 1931 XYZ → linear Rec.709 without adaptation: D65's white of luminance 1 becomes (1,1,1).
glm::dmat3 xyz_to_rec709();

/// Whether the primaries span a triangle and the white point has luminance.
bool is_usable(const Primaries& primaries);

}  // namespace rowland::colour
