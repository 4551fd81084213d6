#pragma once

#include <cstdint>

#include "engine/image/byte_image.h"

namespace rowland::scene {

/// Marks of use on a surface, the members of the glTF material extension ROWLAND_materials_wear. The densities go from
/// 0, none, to 1: per square metre 170 000 scratches, 400 fingerprints, and 3 million specks of dust and 6 000 fibres,
/// which together cover 1 % of it.
struct Wear {
    float scratches = 0.0F;
    float fingerprints = 0.0F;
    float dust = 0.0F;
    float size_m = 0.12F;  ///< width and height of the surface on which u and v go from 0 to 1; 0.005 to 2
    std::uint32_t seed = 1;

    friend bool operator==(const Wear&, const Wear&) = default;
};

inline constexpr int kWearTexels = 1024;  ///< along each side of wear_map()

/// Draws the marks as coverage, which repeats from 0 to 1 in u and v. R: dust; G: grease; B and A: that of scratches
/// times the cosine and the sine of twice their angle from u to v, stored as 128 + 127 x. The doubled angle makes
/// opposite directions equal, and lets scratches of all directions average to 0. Equal arguments give equal bytes.
image::ByteImage wear_map(const Wear& wear);

/// Multiplies the coverage by the mask's red channel, interpolated bilinearly; both images span 0 to 1 in u and v.
void mask_wear(const image::ByteImage& mask, image::ByteImage& map);

}  // namespace rowland::scene
