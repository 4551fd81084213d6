#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "engine/lighting/light_samples.h"
#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// A plane's axes in the world: (e1, e2, n) right-handed. e1 comes from +X by the smallest rotation that takes the
/// nearer of +Y and −Y to n.
struct PlaneAxes {
    glm::dvec3 e1{1.0, 0.0, 0.0};
    glm::dvec3 e2{0.0, 1.0, 0.0};
    glm::dvec3 n{0.0, 0.0, 1.0};
};
PlaneAxes plane_axes(const glm::dvec3& normal);

/// The light of the upper hemisphere seen along n (orthographic): flux · s_n T(s_n) / 2 over (s·e1, s·e2) ∈ [−1, 1]² in
/// equal cells. Each sample is divided among the four cells around it, so that their centre of weight is its position.
struct LightDisc {
    int cells = 0;              ///< of a side; cell i is centred on (2i + 1)/cells − 1
    std::vector<float> fluxes;  ///< four floats (r, g, b, 0) per cell, row by row; rows along e2
};
/// Adds light to a cell, or to another four floats.
inline void add_scaled(float* to, const float* light, float weight) {
    for (int c = 0; c < 4; ++c) to[c] += weight * light[c];
}
/// The columns [begin, end) outside which a row is black. A cell holds light from up to a cell away.
std::pair<int, int> lit_columns(int cells, int row);

/// Uses all cores; the result does not depend on their number.
LightDisc light_on_disc(const lighting::LightSamples& texels, const PlaneAxes& axes, const std::optional<Cover>& cover,
                        int cells);

/// The radiance of a flat grating under a probe, flat lobe (PHYSICS §6 "planar"): XYZ over the azimuth of g in the
/// plane and v_g. A 2D texture: GL_LINEAR, GL_REPEAT in s, GL_CLAMP_TO_EDGE in t. With a pitch axis a volume of such
/// slices, a slice for each node, GL_CLAMP_TO_EDGE in r.
///   azimuth φ: g = cos φ e1 + sin φ e2, column i holds φ = 2π i/azimuths;   s = φ/2π + ½/azimuths
///   v_g: row j holds v_g = 2j/(views−1) − 1, both ends included;   t = (½(v_g+1)(views−1) + ½)/views
struct PlanarMap {
    int azimuths = 0;
    int views = 0;
    glm::dvec3 e1{1.0, 0.0, 0.0};  ///< (e1, e2, n) right-handed, world axes
    glm::dvec3 e2{0.0, 1.0, 0.0};
    glm::dvec3 n{0.0, 0.0, 1.0};
    std::optional<PitchAxis> pitch{};
    std::vector<glm::vec3> xyz;  ///< row by row of the texture: index (slice·views + j)·azimuths + i

    int slices() const { return pitch ? pitch->nodes : 1; }
};

struct PlanarMapSize {
    int azimuths = 256;  ///< even, ≥ 4
    int views = 128;     ///< ≥ 8
    std::optional<PitchAxis> pitch{};
};

/// The map of so many views: light changes faster along the azimuth than radiance does along v_g, which the kernel
/// smooths.
constexpr PlanarMapSize planar_map_size(int views) {
    return {.azimuths = 2 * views, .views = views, .pitch = std::nullopt};
}

/// The size of the map that is shown while a larger one is filled: it is filled within 10 ms on two cores.
inline constexpr PlanarMapSize kCoarsePlanarMap{.azimuths = 64, .views = 64, .pitch = std::nullopt};

/// Fills a map with values for linear interpolation: they are not the radiance at the nodes.
/// `zero_order_xyz`: as of ColourKernel. `cover`: T(s_n) is in the map, T(v_n) is not. Light is spread over the
/// azimuths between two nodes (PHYSICS §6). Uses all cores; the result does not depend on their number. After a stop
/// request it returns early with an unusable map.
PlanarMap fill_planar_map(const lighting::LightSamples& texels, const KernelTable& kernel, double pitch_nm,
                          const glm::dvec3& normal, const PlanarMapSize& size = {},
                          const glm::dmat3& zero_order_xyz = glm::dmat3(0.0),
                          const std::optional<Cover>& cover = std::nullopt, const std::stop_token& stop = {});

/// sample(fill_planar_map(...), point) for few points: fills the columns that a point sees. For one thread.
std::function<glm::dvec3(const ShadingPoint&)> planar_map_of_points(const lighting::LightSamples& texels,
                                                                    const KernelTable& kernel, double pitch_nm,
                                                                    const glm::dvec3& normal, const PlanarMapSize& size,
                                                                    const glm::dmat3& zero_order_xyz,
                                                                    const std::optional<Cover>& cover);

/// XYZ at an azimuth (radians, unbounded) and a v_g, as the texture unit interpolates. Only maps with a pitch axis
/// use the pitch factor.
glm::dvec3 sample(const PlanarMap& map, double azimuth, double v_g, double pitch_factor = 1.0);

/// XYZ of a point whose normal is the map's; black for a view below the horizon.
glm::dvec3 sample(const PlanarMap& map, const ShadingPoint& frame, double pitch_factor = 1.0);

}  // namespace rowland::diffraction
