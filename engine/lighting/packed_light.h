#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_samples.h"

namespace rowland::lighting {

/// A probe's whole light for storage: a sample in each cell of a cube map (CubeLayout's order), 8 bytes each. It has
/// the cell's flux and a position within the cell, so a compact lamp keeps its flux and its direction.
struct PackedLight {
    int face_size = 0;                    ///< cells a side of a face; 0: no light
    float scale = 1.0F;                   ///< flux per stored unit, a power of two
    std::vector<std::uint16_t> halves;    ///< flux: all red, all green, all blue; half floats ≥ 0, 18·face_size²
    std::vector<std::uint8_t> positions;  ///< of the samples in their cells: all along s, then all along t, in 256ths
                                          ///< of a side; 12·face_size²

    std::size_t bytes() const { return 2 * halves.size() + positions.size(); }
};

inline constexpr int kMaximumLightFace = 1024;

/// The light of a probe: flux ≥ 0, none of it subnormal when summed. 1 ≤ face_size ≤ kMaximumLightFace. Flux is rounded
/// to 1/2048 of itself, positions to 1/512 of a cell's side.
PackedLight pack(std::span<const CubeCell> cells, int face_size);
PackedLight pack(const LightSamples& texels, int face_size);

/// The samples, minus the lobes of `keys`, which are appended as samples of negative flux: lobes and samples together
/// have the whole flux, whichever lobes those are. Black samples are left out. Does not depend on the number of
/// threads.
LightSamples unpack(const PackedLight& light, std::span<const KeyLight> keys = {});

}  // namespace rowland::lighting
