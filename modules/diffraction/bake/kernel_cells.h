#pragma once

#include <cmath>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "modules/diffraction/model/colour_kernel.h"

namespace rowland::diffraction {

/// Pitches that vary over the surface: factors of the material's pitch, at equal steps of their logarithm.
struct PitchAxis {
    double smallest = 0.5;  ///< > 0
    double largest = 2.0;   ///< > smallest
    int nodes = 32;         ///< ≥ 2

    double factor_at(int node) const {
        return smallest * std::pow(largest / smallest, static_cast<double>(node) / (nodes - 1));
    }
    /// 0 at the smallest, 1 at the largest.
    double position_of(double factor) const { return std::log(factor / smallest) / std::log(largest / smallest); }
    /// Scale and offset from a factor's logarithm to the coordinate of a texture of so many texels.
    glm::dvec2 scale_bias() const {
        const double scale = (nodes - 1.0) / nodes / std::log(largest / smallest);
        return {scale, 0.5 / nodes - scale * std::log(smallest)};
    }

    friend bool operator==(const PitchAxis&, const PitchAxis&) = default;
};

/// Linear interpolation of f at step h exceeds f by h² f''/12 on average. Nodes therefore hold f minus this fraction of
/// their second difference, which more than halves the interpolation's RMS error.
inline constexpr float kBestLinear = 1.0F / 12.0F;

/// The same fraction for the views of KernelCells, at step h. It is larger by 1/32, as light that is divided linearly
/// between two cells of width ½ h adds a variance of h²/24, and the kernel's mean over a cell adds h²/48.
inline constexpr float kBestView = kBestLinear + 1.0F / 32.0F;

/// Four numbers in one vector register.
using Four = float __attribute__((vector_size(4 * sizeof(float))));

/// A colour kernel over equal cells, for correlation with arc profiles: 2(views − 1) cells of a ∈ [−1, 1] and views at
/// v_g = 2j/(views−1) − 1. A weight is d times the kernel's mean over a cell of a + v_g; it depends on the sum alone,
/// unless the kernel also depends on the view.
class KernelCells {
 public:
    /// pitch_nm > 0, views ≥ 2. `zero_order_xyz`: ColourKernel::zero_order_xyz().
    KernelCells(const KernelTable& kernel, double pitch_nm, int views, const glm::dmat3& zero_order_xyz);

    int cells() const { return cells_; }

    /// `light`: ½ flux · s_n in cells of a, 3·kFours per cell: red of 4·kFours independent profiles, then green, then
    /// blue. `xyz` gets 3·kFours per view, likewise, for linear interpolation. kFours is 10, 20 or 24.
    template <int kFours>
    void correlate(std::span<const Four> light, std::span<Four> xyz) const;

    /// One profile: four floats (r, g, b, –) per cell, four (X, Y, Z, –) per view.
    void correlate_rgb(std::span<const float> light, std::span<float> xyz) const;

 private:
    /// Lowers the inner views by kBestView of their second difference. `count` values per view.
    template <typename Value>
    void sharpen(std::span<Value> xyz, std::size_t count) const;

    /// The cells, from `begin` to before `end`, in which a view has weights other than 0.
    struct Range {
        int begin;
        int end;
    };
    Range range(int view) const;
    const float* weights(int view, int cell) const;

    int views_;
    int cells_;
    int first_ = 0;  ///< weights outside [first_, end_) are 0
    int end_ = 0;
    std::vector<float> weights_;   ///< 12 per sum: columns of the matrix, each padded to four
    std::size_t view_stride_ = 2;  ///< sums from the weights of a view's first cell to those of the next view's
};

inline constexpr int kLevelsPerOctave = 4;
inline constexpr int kBlurredViews = 25;

/// (v_g − s_g)/(2 − |u|), from −1 to 1: the position of the view among those that u = s_g + v_g allows. At both ends
/// the light or the view is at the horizon, PHYSICS (14.8).
double view_coordinate(double u, double v_g);

/// The dimensions of the texture of a smoothed kernel: 2D, GL_LINEAR, GL_CLAMP_TO_EDGE.
///   s = ((x − begin)/(end − begin) (columns−1) + ½)/columns
///   t = (log₂(σ/narrowest)·levels_per_octave + ½)/levels
/// Where k depends on the view, such a texture for each of kBlurredViews, at view_coordinate() = 2j/(kBlurredViews−1)
/// − 1.
struct BlurLayout {
    double begin_nm = 0.0;
    double end_nm = 0.0;
    double narrowest_nm = 0.0;  ///< σ of level 0
    int columns = 0;
    int levels = 0;
    int levels_per_octave = kLevelsPerOctave;
    int views = 1;
    double pitch_nm = 0.0;  ///< of the grating
};

/// k smoothed by normal distributions, over x and the deviation σ: the response to a light of that extent in one
/// look-up. Three texels (the matrix's columns) per entry.
struct BlurredKernel : BlurLayout {
    std::vector<glm::mat3> values;  ///< per nm; view by view, level by level

    /// The value that the texture unit interpolates: 0 at the table's ends, and no narrower than a column.
    glm::dmat3 at(double x_nm, double deviation_nm, double v_g = 0.0) const;
};

/// σ from 1 nm to at least `widest_nm` ≥ 1; x to 4σ beyond the kernel. Stencils are narrower than σ by what columns and
/// interpolation add, so that at() gives the kernel smoothed by σ. Where σ is wider than the kernel's features, values
/// fall as 1/σ; between n levels per octave, interpolation is then off by (ln 2/n)²/8: .4 % for 4, .1 % for 8.
BlurredKernel blur(const KernelTable& kernel, double pitch_nm, double widest_nm, int columns = 2048,
                   int levels_per_octave = kLevelsPerOctave);

/// The layout for lights and pixels on a grating of this pitch: deviations of u up to .2, at most `most_columns`
/// columns. A kernel of several views gets half as many columns and one level per octave fewer.
BlurLayout layout_for_lights(const KernelTable& kernel, double pitch_nm, int most_columns = 4096,
                             int levels_per_octave = kLevelsPerOctave);
BlurredKernel blur(const KernelTable& kernel, const BlurLayout& layout);
BlurredKernel blur_for_lights(const KernelTable& kernel, double pitch_nm, int most_columns = 4096,
                              int levels_per_octave = kLevelsPerOctave);

/// The uniforms of shaders/kernel.glsl, which looks up u = x/d instead of x.
struct KernelUniforms {
    glm::vec4 scale_bias{0.0F};  ///< scale and offset from u to s; deviation of u in level 0; scale of the values: d
    glm::vec2 rows{0.0F};        ///< scale and offset from log2(deviation of u) to t
    glm::vec2 reach{0.0F};       ///< centre and half-width of the |u| where k is not 0
};
KernelUniforms kernel_uniforms(const KernelTable& kernel, const BlurLayout& layout);
/// The uniform `kernel_views` of shaders/kernel.glsl under KERNEL_VIEWS: factors of the layer and of the view's
/// position from 0 to 1, and offset, to r, for a 3D texture of `layers` times the kernel's views. `first`: the layer
/// that the texture begins with.
glm::vec3 kernel_views(const BlurLayout& layout, std::size_t layers, std::size_t first = 0);

}  // namespace rowland::diffraction
