#include "engine/post/glare_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>

namespace rowland::post {

namespace {

/// The uniform quadratic B-spline.
float spline(float distance) {
    const float d = std::abs(distance);
    if (d < 0.5F) return 0.75F - d * d;
    return d < 1.5F ? 0.5F * (1.5F - d) * (1.5F - d) : 0.0F;
}

void add_point(const glm::vec2& position, const glm::mat3& weight, const GlareGrid& grid,
               std::vector<glm::mat3>& kernel) {
    const glm::ivec2 nearest(glm::round(position));
    for (int y = nearest.y - 1; y <= nearest.y + 1; ++y) {
        if (std::abs(y) >= grid.cells.y) continue;
        const float up = spline(position.y - static_cast<float>(y));
        for (int x = nearest.x - 1; x <= nearest.x + 1; ++x) {
            if (std::abs(x) >= grid.cells.x) continue;
            const glm::ivec2 at = (glm::ivec2(x, y) + grid.period) % grid.period;
            kernel[static_cast<std::size_t>(at.y * grid.period.x + at.x)] +=
                up * spline(position.x - static_cast<float>(x)) * weight;
        }
    }
}

}  // namespace

glm::vec2 reach_of(const GlarePattern& pattern, const glm::mat2& turn) {
    glm::vec2 reach(0.0F);
    for (const GlarePattern::Point& point : pattern.points) reach = glm::max(reach, glm::abs(turn * point.offset));
    return reach;
}

std::vector<glm::mat3> glare_kernel(const GlarePattern& pattern, const glm::mat2& turn, const GlareGrid& grid) {
    std::vector<glm::mat3> kernel(static_cast<std::size_t>(grid.period.x) * static_cast<std::size_t>(grid.period.y),
                                  glm::mat3(0.0F));
    for (const GlarePattern::Point& point : pattern.points) {
        const glm::vec2 position = turn * point.offset / grid.cell;
        if (std::abs(position.x) < static_cast<float>(grid.cells.x + 1) &&
            std::abs(position.y) < static_cast<float>(grid.cells.y + 1))
            add_point(position, point.weight, grid, kernel);
    }
    return kernel;
}

}  // namespace rowland::post
