#pragma once

#include <glm/vec2.hpp>

namespace rowland::post {

/// The square cells that glare is computed on: even in direction cosines, where a diffraction pattern is the same
/// everywhere. Cell (i, j) is centred at ((i, j) − (cells − 1) / 2) · cell.
struct GlareGrid {
    glm::ivec2 cells{0};   ///< that cover the picture
    glm::ivec2 period{0};  ///< of the Fourier transform, powers of two: what leaves the picture must not return
    float cell = 0.0F;     ///< side in direction cosines

    friend bool operator==(const GlareGrid&, const GlareGrid&) = default;
};

/// The longest transforms. OpenGL promises 1024 invocations and 32 KiB shared by them: a row in one colour channel, a
/// column in three.
inline constexpr glm::ivec2 kLargestGlarePeriod{2048, 1024};

/// Cells of 2 to 3 pixels, or larger ones where the transforms would be too long. `tan_half_fov`: of the horizontal and
/// the vertical field of view. `reach`: the largest offset of a pattern in x and y.
GlareGrid glare_grid(glm::ivec2 picture, glm::vec2 tan_half_fov, glm::vec2 reach);

}  // namespace rowland::post
