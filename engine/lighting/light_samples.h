#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "engine/lighting/probe_image.h"

namespace rowland::lighting {

/// A probe as point samples of directions, a structure of arrays.
struct LightSamples {
    std::vector<float> x, y, z;           ///< unit directions, world axes
    std::vector<float> red, green, blue;  ///< flux: radiance × solid angle. May be negative (see light_samples())

    std::size_t size() const { return x.size(); }
    glm::dvec3 direction(std::size_t i) const { return {x[i], y[i], z[i]}; }
    glm::dvec3 flux(std::size_t i) const { return {red[i], green[i], blue[i]}; }
    void resize(std::size_t size);
    void set(std::size_t i, const glm::dvec3& direction, const glm::dvec3& flux);
    void push_back(const glm::dvec3& direction, const glm::dvec3& flux);
};

/// The largest side of a texel, in radians, that is one sample by default.
inline constexpr double kMaximumTexelSide = 0.0065;

/// Samples of a probe's texels, from which the lobes of `keys` are subtracted: lobes and samples together have the
/// probe's flux. Texels with a side above `largest_side`, in radians, are subdivided into samples of bilinearly
/// interpolated radiance. Does not depend on the number of threads. 24 bytes per sample: 12 MB for 1024 × 512 texels.
LightSamples light_samples(const ProbeImage& probe, std::span<const KeyLight> keys = {},
                           double largest_side = kMaximumTexelSide);

/// Sums over the samples in one cell of a cube map. A sample's weight is |red| + |green| + |blue| of its flux.
struct CubeCell {
    glm::dvec3 flux{0.0};
    glm::dvec3 direction_sum{0.0};  ///< Σ weight · direction
    glm::dvec2 position_sum{0.0};   ///< Σ weight · position in the cell, in [0, 1]²
};

/// The samples of a probe, summed in the cells of a cube map of `face_size` cells a side, in the order of CubeLayout
/// (environment_map.h). Memory use does not depend on the probe's size.
std::vector<CubeCell> bin_into_cells(const ProbeImage& probe, int face_size);
std::vector<CubeCell> bin_into_cells(const LightSamples& texels, int face_size);

/// One sample per cell that is not black, in its weighted mean direction: a lamp smaller than a cell keeps its
/// direction.
LightSamples cell_samples(std::span<const CubeCell> cells);
/// Reduces samples to one per cell of a cube map.
LightSamples merge_samples(const LightSamples& texels, int face_size);

/// Subtracts a lobe too narrow for the cells (κ ≥ 100): appends 3 × 8 samples of negative flux on circles around its
/// direction, with the lobe's low-order moments.
void subtract_narrow_lobe(const KeyLight& key, LightSamples& samples);

/// All light of a probe, packed for storage: one sample per cell of a cube map (CubeLayout's order), of 8 bytes. A
/// sample has the cell's flux and a position within the cell, so a compact lamp keeps its flux and its direction.
struct PackedLight {
    int face_size = 0;                    ///< cells per side of a face; 0: no light
    float scale = 1.0F;                   ///< flux per stored unit, a power of two
    std::vector<std::uint16_t> halves;    ///< flux: all red, all green, all blue; half floats ≥ 0, 18·face_size²
    std::vector<std::uint8_t> positions;  ///< of the samples in their cells: all along s, then all along t, in 256ths
                                          ///< of a side; 12·face_size²

    std::size_t bytes() const { return 2 * halves.size() + positions.size(); }
};

inline constexpr int kMaximumLightFace = 1024;

/// Packs the light of a probe, whose flux is ≥ 0 and not subnormal. 1 ≤ face_size ≤ kMaximumLightFace. Flux is rounded
/// to 1/2048 of itself, positions to 1/512 of a cell's side.
PackedLight pack(std::span<const CubeCell> cells, int face_size);
PackedLight pack(const LightSamples& texels, int face_size);

/// The samples, then the lobes of `keys` as samples of negative flux: lobes and samples together have the whole flux,
/// including that of lobes narrower than a cell. Black samples are omitted. Does not depend on the number of threads.
LightSamples unpack(const PackedLight& light, std::span<const KeyLight> keys = {});

}  // namespace rowland::lighting
