#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "engine/lighting/probe_image.h"

namespace rowland::lighting {

/// A probe as point samples, one array a component, all of one length: for sums over directions that count all of the
/// sphere once.
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

/// Whether lobe_fractions() holds for directions whose cells have sides of at most `side` radians: the midpoint rule
/// needs a deviation of a side.
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

/// Appends samples of the negative flux of a lobe of κ ≥ 100, whose low moments they have: three circles of eight.
void subtract_narrow_lobe(const KeyLight& key, LightSamples& samples);

}  // namespace rowland::lighting
