#include "engine/post/glare_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rowland::post {

namespace {

constexpr float kFinestCell = 2.0F;    ///< pixels; finer ones would be sampled unevenly by the pixels
constexpr float kCoarsestCell = 3.0F;  ///< pixels, as far as the transforms allow
constexpr int kMargin = 6;             ///< cells: the splines, the picture's edges
constexpr int kShortestPeriod = 32;

int period_for(float cells, int largest) {
    const auto needed = static_cast<unsigned>(std::ceil(std::min(cells, static_cast<float>(largest))));
    return std::clamp(static_cast<int>(std::bit_ceil(needed)), kShortestPeriod, largest);
}

}  // namespace

GlareGrid glare_grid(glm::ivec2 picture, glm::vec2 tan_half_fov, glm::vec2 reach) {
    const float pixel = 2.0F * tan_half_fov.y / static_cast<float>(picture.y);
    GlareGrid grid{.cell = kFinestCell * pixel};
    glm::vec2 extent;
    for (int axis = 0; axis < 2; ++axis) {
        extent[axis] = 2.0F * tan_half_fov[axis] / std::sqrt(1.0F + tan_half_fov[axis] * tan_half_fov[axis]);
        // Offsets beyond the picture's own size leave it from everywhere.
        const float filled = extent[axis] + std::min(reach[axis], extent[axis]);
        grid.period[axis] =
            period_for(filled / (kCoarsestCell * pixel) + static_cast<float>(kMargin), kLargestGlarePeriod[axis]);
        grid.cell = std::max(grid.cell, filled / static_cast<float>(grid.period[axis] - kMargin));
    }
    for (int axis = 0; axis < 2; ++axis) grid.cells[axis] = static_cast<int>(std::ceil(extent[axis] / grid.cell)) + 2;
    return grid;
}

}  // namespace rowland::post
