#pragma once

#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/post/glare_grid.h"
#include "engine/post/glare_pattern.h"

namespace rowland::post {

/// The largest offset of a pattern, turned by `turn`, in x and y.
glm::vec2 reach_of(const GlarePattern& pattern, const glm::mat2& turn);

/// The pattern, turned, on the grid: at [y · period.x + x] the weights of what moves by (x, y) cells, modulo the
/// period. A point is divided among the nine cells around it by a quadratic B-spline. What moves by more than the
/// picture's size is left out.
std::vector<glm::mat3> glare_kernel(const GlarePattern& pattern, const glm::mat2& turn, const GlareGrid& grid);

}  // namespace rowland::post
