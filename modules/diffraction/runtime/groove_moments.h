#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/image/byte_image.h"

namespace rowland::diffraction {

/// How the texels of a groove texture become moments.
struct GrooveMomentUse {
    bool even = true;             ///< the kernel is: grooves of the angles θ and θ + π are the same
    bool gaps = false;            ///< some texels have no grating
    double smallest_pitch = 1.0;  ///< of the texture, over the material's
};

/// The texels of a groove texture (groove_map.h) as numbers whose means describe the grooves of an area, whatever their
/// distribution (PHYSICS (11.3)): four per texel, of 65535. With c = 1 where there is a grating and 0 elsewhere, the
/// angle θ, j = 2 for even kernels and 1 for others, and q = smallest pitch / pitch:
///   ½ + ½ c cos jθ,  ½ + ½ c sin jθ,  c q,  c q², or c for textures with gaps, whose pitches count as equal.
std::vector<std::uint16_t> groove_moments(const image::ByteImage& image, const GrooveMomentUse& use);

/// The mean area of facets of one direction each: the inverse of the fractions of texels whose grooves are not those of
/// the texel before them, along rows and along columns.
double facet_texels(const image::ByteImage& image);

/// The next level of the moments of facets, from a level of this size: of four texels the grooves of one, drawn at
/// random among those that have a grating, and with `gaps` the mean coverage. The same on every machine.
std::vector<std::uint16_t> facets_of_level(const std::vector<std::uint16_t>& from, const glm::ivec2& size, bool gaps);

}  // namespace rowland::diffraction
