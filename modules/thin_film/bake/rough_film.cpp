#include "modules/thin_film/bake/rough_film.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/parallel.h"

namespace rowland::thin_film {

namespace {

/// Of the path difference: a 26th of the shortest visible fringe, where a cubic is 1e-4 of its height off.
constexpr double kPathStep_nm = 15.0;

/// Weights of four equidistant nodes at 0 to 3 for a value at `at` (Lagrange).
std::array<double, 4> cubic_weights(double at) {
    const double a = at;
    const double b = at - 1.0;
    const double c = at - 2.0;
    const double d = at - 3.0;
    return {-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0};
}

}  // namespace

RoughFilm::RoughFilm(const FilmColour& colour, double thinnest_nm, double thickest_nm) : thinnest_nm_(thinnest_nm) {
    const double range_nm = thickest_nm - thinnest_nm;
    const double finest_nm = kPathStep_nm / (2.0 * std::abs(colour.film().layers.front().index));
    nodes_ = std::max<std::size_t>(static_cast<std::size_t>(std::ceil(range_nm / finest_nm)) + 1, 4);
    step_nm_ = range_nm / static_cast<double>(nodes_ - 1);
    values_.resize(nodes_ * (kAngleSteps + 1));
    parallel_for(kAngleSteps + 1, [&](std::size_t angle) {
        const double root = static_cast<double>(angle) / kAngleSteps;
        const FilmColour::AtAngle at = colour.at(root * root);
        for (std::size_t i = 0; i < nodes_; ++i)
            values_[angle * nodes_ + i] = at(thinnest_nm + static_cast<double>(i) * step_nm_);
    });
}

glm::dmat3 RoughFilm::average(std::span<const double> angles, double thickness_nm) const {
    const double last = static_cast<double>(nodes_ - 1);
    const double position = step_nm_ > 0.0 ? std::clamp((thickness_nm - thinnest_nm_) / step_nm_, 0.0, last) : 0.0;
    const std::size_t first = std::min(static_cast<std::size_t>(std::max(position - 1.0, 0.0)), nodes_ - 4);
    const std::array<double, 4> weights = cubic_weights(position - static_cast<double>(first));
    glm::dmat3 sum(0.0);
    for (std::size_t angle = 0; angle < angles.size(); ++angle) {
        if (angles[angle] == 0.0) continue;
        const glm::dmat3* const at = &values_[angle * nodes_ + first];
        sum += angles[angle] * (weights[0] * at[0] + weights[1] * at[1] + weights[2] * at[2] + weights[3] * at[3]);
    }
    return sum;
}

}  // namespace rowland::thin_film
