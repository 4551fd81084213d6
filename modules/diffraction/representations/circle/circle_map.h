#pragma once

#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "engine/lighting/light_samples.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// A grating vector and the directions from which angles around it are counted: CircleMap's e1 and e2.
struct CircleFrame {
    glm::dvec3 g{0.0};
    glm::dvec3 e1{0.0};
    glm::dvec3 e2{0.0};
};

/// The frame of the smallest rotation from +Y, mirrored for the chart of the lower half.
CircleFrame frame_at(const glm::dvec3& g, int chart);

/// Chart coordinates of g: the stereographic map p = (g_x, g_z)/(1 + g_y), mirrored for the lower half; and back.
glm::dvec2 chart_point(const glm::dvec3& g, int chart);
glm::dvec3 grating_vector(const glm::dvec2& p, int chart);

/// Number of the symmetries of a cube that keep +Y. The nodes and the light cells of circle maps have them: images of a
/// node and a direction have the same s_g and, but for angle_image(), the same angle, so both are computed only once.
inline constexpr std::size_t kCircleImages = 8;

/// Image 0 is the vector itself; 4 exchanges x and z, then 1 reverses x and 2 reverses z.
template <typename Vector>
Vector circle_image(Vector v, std::size_t image) {
    if ((image & 4) != 0) std::swap(v.x, v.z);
    if ((image & 1) != 0) v.x = -v.x;
    if ((image & 2) != 0) v.z = -v.z;
    return v;
}

/// The angle around a frame's g that becomes t for its image: sign · t + quarters · π/2.
struct AngleImage {
    int sign;
    int quarters;
};
AngleImage angle_image(std::size_t image);

/// Functions of g and v_g on nodes.
struct CircleGrid {
    int functions = 0;
    int views = 0;
    int side = 0;                ///< texels of a chart's side
    std::vector<glm::vec3> xyz;  ///< see index()

    std::size_t index(int chart, int function, int view, int row, int column) const;
    /// Scale of chart coordinates to texture coordinates: the equator lies 1½ texels inside the edge.
    double scale() const { return 0.5 - 1.5 / side; }
    /// Scale of v_g to texture coordinates.
    double view_scale() const { return 0.5 - 0.5 / views; }
};

/// The terms of a circle map: on 1, cos t, sin t, cos 2t, sin 2t.
inline constexpr int kCircleTerms = 5;
/// Look-ups that they take, of four components each.
inline constexpr int kTermLookUps = (3 * kCircleTerms + 3) / 4;

/// The radiance of any grating surface of flat lobe under a probe (PHYSICS §6 "circle"): XYZ over the grating vector g
/// in world space, v_g and the normal's angle t around g. It does not depend on the object.
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
///   XYZ = Σ_i term_i · f_i + remainder(t), f = 1, cos t, sin t, cos 2t, sin 2t
/// The remainder of the series has the period π (2π under a cover, where T(v_n) is left out): function j of `remainder`
/// holds it where circle_turn() of cos 2t, sin 2t (cos t, sin t) is j/functions, linear between. It is small, so it has
/// fewer nodes (remainder_side(), remainder_views()).
struct CircleMap {
    int charts = 0;  ///< 1 or 2
    bool covered = false;
    CircleGrid terms;
    CircleGrid remainder;  ///< none: no functions

    double period() const { return covered ? 2.0 * std::numbers::pi : std::numbers::pi; }
};

struct CircleMapSize {
    int side = 104;   ///< of the terms, ≥ 8
    int views = 130;  ///< of the terms, ≥ 8
    int angles = 14;  ///< of the remainder, for half a turn of the normal; 0: the series ends at cos 2t
};

/// Nodes of the remainder: 8 for 13 of the terms' on each axis.
int remainder_side(int side);
int remainder_views(int views);
/// Functions of the remainder.
int rest_angles(int angles, bool covered);

/// The angles for half a turn that a grating's map has by default: fewer under a cover, which lets in less light at
/// grazing angles, where the series converges slowly.
int circle_angles(const std::optional<Cover>& cover);

/// The size of the map that is shown while a larger one is filled.
CircleMapSize coarser(CircleMapSize size);

/// Multiples of the angle that a map is filled from.
inline constexpr int kCircleMultiples = 13;

/// The Fourier coefficients of T(r cos t) max(0, cos t) on cos kt, k < kCircleMultiples, PHYSICS (10.3); without a
/// cover T = 1, and r does not matter.
std::array<double, kCircleMultiples> clamped_cosine(const std::optional<Cover>& cover, double r);

/// Where the direction (c, s) lies on an axis that replaces its angle: −½ to ½ of a turn, as steep as the angle within
/// 6 %. With y = (|c| − |s|)/(|c| + |s|) it is ⅛ − ⅛ y (1.2 − .2 y²) in the first quadrant.
double circle_turn(double c, double s);

/// The number of charts of a map under this kernel.
int chart_count(const KernelTable& kernel);

/// Fills the map from texels (without key lights, which are shaded one by one). Uses all cores; the result does not
/// depend on their number. `zero_order_xyz`: as of ColourKernel. After a stop request it returns early with an unusable
/// map.
CircleMap fill_circle_map(const lighting::LightSamples& texels, const KernelTable& kernel, double pitch_nm,
                          const CircleMapSize& size = {}, const glm::dmat3& zero_order_xyz = glm::dmat3(0.0),
                          const std::optional<Cover>& cover = std::nullopt, const std::stop_token& stop = {});

/// XYZ of a point as texture units interpolate (GL_LINEAR on all three axes); black for a view below the horizon.
glm::dvec3 sample(const CircleMap& map, const ShadingPoint& frame);

}  // namespace rowland::diffraction
