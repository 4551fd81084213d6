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

/// A probe as point samples, one array per component, all of one length. They cover the whole sphere once.
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

/// Texels longer than this, in radians, are divided into several samples of bilinearly interpolated radiance.
inline constexpr double kTexelSide = 0.0065;

/// A sample for each texel of a probe, minus the lobes of `keys`: both together have the probe's flux. Does not depend
/// on the number of threads. 24 bytes per sample: 12 MB for 1024 × 512 texels.
LightSamples light_samples(const ProbeImage& probe, std::span<const KeyLight> keys = {},
                           double largest_side = kTexelSide);

/// The sums over the samples that lie in a texel of a cube map. Weights are |red| + |green| + |blue| of the flux.
struct CubeCell {
    glm::dvec3 flux{0.0};
    glm::dvec3 direction{0.0};  ///< Σ weight · direction
    glm::dvec2 position{0.0};   ///< Σ weight · position in the cell along s and t, in [0, 1]²
};

/// The samples of a probe, summed in the cells of a cube map of `face_size` cells a side, in CubeLayout's order. Memory
/// is that of the cells, however large the probe.
std::vector<CubeCell> gather_cells(const ProbeImage& probe, int face_size);
std::vector<CubeCell> gather_cells(const LightSamples& texels, int face_size);

/// A sample for each cell that holds light, in its weighted mean direction: a compact lamp keeps its direction.
LightSamples cell_samples(std::span<const CubeCell> cells);
/// cell_samples(gather_cells(…)).
LightSamples gather_texels(const LightSamples& texels, int face_size);

/// How the flux of a lobe divides among directions: fractions that sum to 1.
struct LobeFractions {
    std::vector<std::size_t> indices;
    std::vector<double> fractions;
};

/// Whether the midpoint rule of lobe_fractions() holds for cells with sides of at most `side` radians: the lobe's
/// deviation is at least a side.
inline bool is_resolved(const KeyLight& key, double side) {
    return key.concentration * side * side < 1.0;
}

/// Integrates the lobe by the midpoint rule: `direction(i)` and `solid_angle(i)` for i < count.
template <typename Direction, typename SolidAngle>
LobeFractions lobe_fractions(const KeyLight& key, std::size_t count, const Direction& direction,
                             const SolidAngle& solid_angle) {
    // κ(1 − cos) beyond which the density, exp(−this) of its peak, does not count.
    constexpr double kReach = 30.0;
    LobeFractions result;
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 s = direction(i);
        const double cosine = s.x * key.direction.x + s.y * key.direction.y + s.z * key.direction.z;
        if (key.concentration * (1.0 - cosine) >= kReach) continue;
        result.indices.push_back(i);
        result.fractions.push_back(lobe_density(key, s) * solid_angle(i));
        sum += result.fractions.back();
    }
    for (double& fraction : result.fractions) fraction /= sum;
    return result;
}

/// Appends three circles of eight samples whose negative flux has the low moments of a lobe of κ ≥ 100.
void subtract_narrow_lobe(const KeyLight& key, LightSamples& samples);

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

/// The samples, then the lobes of `keys` as samples of negative flux: lobes and samples together have the whole flux,
/// for any lobes. Black samples are omitted. Does not depend on the number of threads.
LightSamples unpack(const PackedLight& light, std::span<const KeyLight> keys = {});

}  // namespace rowland::lighting
