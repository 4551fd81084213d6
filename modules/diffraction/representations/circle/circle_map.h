#pragma once

#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>
#include <stop_token>
#include <vector>

#include "engine/lighting/light_samples.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/model/cover.h"
#include "modules/diffraction/model/shading_point.h"

namespace rowland::diffraction {

/// Nodes of some terms of a circle map.
struct CircleLevel {
    int first_term = 0;
    int terms = 0;
    int views = 0;
    int side = 0;                ///< texels of a chart's side
    std::vector<glm::vec3> xyz;  ///< see index()

    /// `term` counts from first_term.
    std::size_t index(int chart, int term, int view, int row, int column) const;
    /// Scale of chart coordinates to texture coordinates: the equator lies 1½ texels inside the edge.
    double scale() const { return 0.5 - 1.5 / side; }
};

/// The radiance of any grating surface of flat lobe under a probe (PHYSICS §6 "circle"): XYZ over the grating vector g
/// in world space and v_g, as a Fourier series in the normal's angle t around g. It does not depend on the object.
///
/// Chart 0 holds g of the upper half (g_y ≥ 0), chart 1 of the lower, each with a rim beyond the equator. An even
/// kernel, k(−x) = k(x), needs chart 0 alone: (g, v_g) and (−g, −v_g) are then equal.
///   chart coordinates: G = g, mirrored into the upper half for chart 1 as (g_x, −g_y, g_z);
///     p = (G_x, G_z)/(1 + G_y) (stereographic: |p| ≤ 1 on the half, finest where g is horizontal, as on horizontal
///     discs and on upright bodies of revolution);  s, t = ½ + p · scale
///   angle: e1 = (1,0,0) − G_x/(1+G_y) · (G_x, G_y+1, G_z), e2 = (0,0,1) − G_z/(1+G_y) · (G_x, G_y+1, G_z), both with y
///     mirrored back for chart 1; cos t = n·e1, sin t = n·e2
///   v_g: slice j holds v_g = 2j/(views−1) − 1, both ends included; coordinate (½(v_g+1)(views−1) + ½)/views
///   values are optimised for linear interpolation (kBestLinear), not the radiance at the nodes
///   XYZ = Σ_i term_i · f_i, f = 1, cos t, sin t, cos 2t, sin 2t, cos 4t, sin 4t (, cos 6t, sin 6t)
/// Under a cover f ends with cos 3t, sin 3t, cos 5t, sin 5t (PHYSICS §10), and T(v_n) is left out.
/// The terms from the sixth on are small, so they have half as many nodes on each axis: level 1.
struct CircleMap {
    int charts = 0;  ///< 1 or 2
    bool covered = false;
    std::array<CircleLevel, 2> levels;
};

struct CircleMapSize {
    int side = 112;   ///< of level 0: even, ≥ 8
    int views = 140;  ///< of level 0: even, ≥ 8
    int terms = 7;    ///< 5: up to cos 2t; 7: to cos 4t; 9: to cos 6t. Under a cover 9: with cos 3t; 11: with cos 5t
};

/// The first of these terms are in level 0.
inline constexpr int kFineTerms = 5;

/// Of the map that is shown while a larger one is filled: within a tenth of a second on two cores.
inline constexpr int kCoarseCircleSide = 16;

/// The terms that a grating's map has by default: under a cover the multiples 3 and 5 as well.
int circle_terms(const std::optional<Cover>& cover);

/// Fourier series of max(0, cos t) on 1, cos t, cos 2t, cos 4t, cos 6t.
inline constexpr std::array<double, 5> kClampedCosine{1.0 / std::numbers::pi, 0.5, 2.0 / (3.0 * std::numbers::pi),
                                                      -2.0 / (15.0 * std::numbers::pi),
                                                      2.0 / (35.0 * std::numbers::pi)};

/// The Fourier coefficients of T(r cos t) max(0, cos t) on 1, cos t, cos 2t, cos 4t, cos 3t, cos 5t, PHYSICS (28).
std::array<double, 6> covered_cosine(double ior, double r);

/// The look-ups of each level of a map of so many terms: four components each.
std::array<int, 2> look_ups_of(int terms);

/// The number of charts of a map under this kernel.
int chart_count(const KernelTable& kernel);

/// Fills the map from texels (without key lights, which `direct` adds). Uses all cores; the result does not depend on
/// their number. `zero_order_xyz`: as of ColourKernel. After a stop request it returns early with an unusable map.
CircleMap fill_circle_map(const lighting::LightSamples& texels, const KernelTable& kernel, double pitch_nm,
                          const CircleMapSize& size = {}, const glm::dmat3& zero_order_xyz = glm::dmat3(0.0),
                          const std::optional<Cover>& cover = std::nullopt, const std::stop_token& stop = {});

/// XYZ of a point as texture units interpolate (GL_LINEAR on all three axes); black for a view below the horizon.
glm::dvec3 sample(const CircleMap& map, const ShadingPoint& frame);

}  // namespace rowland::diffraction
