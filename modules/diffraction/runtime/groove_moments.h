#pragma once

#include <cstdint>
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
/// distribution (PHYSICS (40)): four per texel, of 65535. With c = 1 where there is a grating and 0 elsewhere, the
/// angle θ, j = 2 for even kernels and 1 for others, and q = smallest pitch / pitch:
///   ½ + ½ c cos jθ,  ½ + ½ c sin jθ,  c q,  c q², or c for textures with gaps, whose pitches count as equal.
std::vector<std::uint16_t> groove_moments(const image::ByteImage& image, const GrooveMomentUse& use);

}  // namespace rowland::diffraction
