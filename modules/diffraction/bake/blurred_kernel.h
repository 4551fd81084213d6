#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "modules/diffraction/model/colour_kernel.h"

namespace rowland::diffraction {

inline constexpr int kLevelsPerOctave = 4;

/// k smoothed by normal distributions, over x and the deviation σ: the response to a light of that extent in one
/// look-up. A 2D texture, GL_LINEAR, GL_CLAMP_TO_EDGE, three texels (the matrix's columns) per entry.
///   s = ((x − begin)/(end − begin) (columns−1) + ½)/columns
///   t = (log₂(σ/narrowest)·levels_per_octave + ½)/levels
struct BlurredKernel {
    double begin_nm = 0.0;
    double end_nm = 0.0;
    double narrowest_nm = 0.0;  ///< σ of level 0
    int columns = 0;
    int levels = 0;
    int levels_per_octave = kLevelsPerOctave;
    std::vector<glm::mat3> values;  ///< per nm; level by level

    /// Interpolated as the texture unit does. 0 at the table's ends. At least as wide as a column.
    glm::dmat3 at(double x_nm, double deviation_nm) const;
};

/// σ from 1 nm to at least `widest_nm` ≥ 1; x to 4σ beyond the kernel. A value is what at() is to give for σ: the
/// stencil is narrower by what columns and interpolation add. Where σ is wider than the kernel's features, values are
/// as 1/σ, and n levels an octave are off by (ln 2/n)²/8 between them: .4 % for 4, .1 % for 8.
BlurredKernel blur(const KernelTable& kernel, double widest_nm, int columns = 2048,
                   int levels_per_octave = kLevelsPerOctave);

/// blur() for lights and pixels on a grating of this pitch: deviations of u up to .2. At most so many columns.
BlurredKernel blur_for_lights(const KernelTable& kernel, double pitch_nm, int most_columns = 4096,
                              int levels_per_octave = kLevelsPerOctave);

/// The uniforms of shaders/kernel.glsl, which looks up u = x/d instead of x.
struct KernelUniforms {
    glm::vec4 scale_bias{0.0F};  ///< scale and offset from u to s; deviation of u in level 0; scale of the values: d
    glm::vec2 rows{0.0F};        ///< scale and offset from log2(deviation of u) to t
    glm::vec2 reach{0.0F};       ///< k is 0 where |u| differs from x by more than y
};
KernelUniforms kernel_uniforms(const KernelTable& kernel, const BlurredKernel& blurred, double pitch_nm);

}  // namespace rowland::diffraction
