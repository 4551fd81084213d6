#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "engine/image/image.h"

namespace rowland::image {

/// CIE 1931 xy of an RGB space.
struct Primaries {
    glm::dvec2 red;
    glm::dvec2 green;
    glm::dvec2 blue;
    glm::dvec2 white;
};

/// ITU-R BT.709 with D65.
inline constexpr Primaries kRec709{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

/// Linear RGB of `from` → linear Rec.709, white adapted to white by Bradford's transform [Lam 1985], or nothing if both
/// are the same to 1e-3. Degenerate primaries (no triangle, a white without luminance) give nothing too:
/// check is_usable() first where that matters.
std::optional<glm::dmat3> to_rec709(const Primaries& from);

/// Whether the primaries span a triangle and the white point is a colour.
bool is_usable(const Primaries& primaries);

/// Multiplies every texel in place.
void transform_colours(Image& image, const glm::dmat3& matrix);

}  // namespace rowland::image
