#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_texels.h"

namespace rowland::lighting {

/// A probe's whole light as small lights, one in each texel of a cube map (CubeLayout's order), for storage: 8 bytes a
/// light. A texel holds its light's flux and place, not only its radiance, so a compact lamp keeps both.
struct PackedLight {
    int face_size = 0;                  ///< texels a side of a face; 0: no light
    float scale = 1.0F;                 ///< flux per stored unit, a power of two
    std::vector<std::uint16_t> halves;  ///< flux: all red, all green, all blue; half floats ≥ 0, 18·face_size²
    std::vector<std::uint8_t> places;  ///< where in its texel a light lies, along s, then along t, in 256ths of a side;
                                       ///< 12·face_size²

    std::size_t bytes() const { return 2 * halves.size() + places.size(); }
};

/// Largest face of a cube of lights.
inline constexpr int kMaximumLightFace = 1024;

/// `texels`: of a probe, so flux ≥ 0, none of it subnormal when summed. 1 ≤ face_size ≤ kMaximumLightFace. A light's
/// flux is rounded to 1/2048 of itself, its place to 1/512 of a texel's side.
PackedLight pack(const LightTexels& texels, int face_size);

/// The lights, less the lobes: `keys` light as much as is taken out here, flux for flux, so that the two together are
/// the whole light, whichever lobes those are. What is taken out are lights of negative flux beside the others. Black
/// lights are left out. Does not depend on the number of threads.
LightTexels unpack(const PackedLight& light, std::span<const KeyLight> keys = {});

}  // namespace rowland::lighting
