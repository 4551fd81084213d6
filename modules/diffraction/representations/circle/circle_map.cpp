#include "modules/diffraction/representations/circle/circle_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/math/quadrature.h"
#include "modules/diffraction/representations/circle/circle_chart.h"

namespace rowland::diffraction {

namespace {

using std::numbers::pi;

/// Where a look-up reads a level.
struct CirclePosition {
    int chart;
    glm::dvec2 p;
    double v_g;
};

glm::dvec3 term_at(const CircleLevel& level, int term, const CirclePosition& look_up) {
    const glm::dvec3 position((look_up.p * level.scale() + 0.5) * static_cast<double>(level.side) - 0.5,
                              0.5 * (look_up.v_g + 1.0) * (level.views - 1));
    glm::dvec3 sum(0.0);
    const auto low = [](double at, int count) { return std::clamp(static_cast<int>(std::floor(at)), 0, count - 2); };
    const int column = low(position.x, level.side);
    const int row = low(position.y, level.side);
    const int view = low(position.z, level.views);
    const glm::dvec3 t = glm::clamp(position - glm::dvec3(column, row, view), 0.0, 1.0);
    for (int corner = 0; corner < 8; ++corner) {
        const int i = corner & 1;
        const int j = (corner >> 1) & 1;
        const int k = corner >> 2;
        const double weight = (i == 1 ? t.x : 1 - t.x) * (j == 1 ? t.y : 1 - t.y) * (k == 1 ? t.z : 1 - t.z);
        sum += weight * glm::dvec3(level.xyz[level.index(look_up.chart, term, view + k, row + j, column + i)]);
    }
    return sum;
}

/// The functions of the normal's angle that the terms are multiplied by.
std::array<double, 11> angle_functions(double c1, double s1, bool covered) {
    const double c2 = c1 * c1 - s1 * s1;
    const double s2 = 2.0 * c1 * s1;
    const double c4 = c2 * c2 - s2 * s2;
    const double s4 = 2.0 * c2 * s2;
    const double c = covered ? c1 : c4;
    const double s = covered ? s1 : s4;
    return {1.0, c1, s1, c2, s2, c4, s4, c * c2 - s * s2, c * s2 + s * c2, c1 * c4 - s1 * s4, c1 * s4 + s1 * c4};
}

}  // namespace

std::size_t CircleLevel::index(int chart, int term, int view, int row, int column) const {
    const auto u = [](int i) { return static_cast<std::size_t>(i); };
    return (((u(chart) * u(terms) + u(term)) * u(views) + u(view)) * u(side) + u(row)) * u(side) + u(column);
}

int circle_terms(const std::optional<Cover>& cover) {
    return cover ? 11 : 7;
}

std::array<double, 6> covered_cosine(double ior, double r) {
    constexpr int kNodes = 32;
    constexpr std::array<int, 6> kMultiples{0, 1, 2, 4, 3, 5};
    static const math::QuadratureRule rule = math::gauss_legendre(kNodes, 0.0, 0.5 * pi);
    std::array<double, 6> series{};
    for (std::size_t node = 0; node < rule.nodes.size(); ++node) {
        const double t = rule.nodes[node];
        const double value = rule.weights[node] * transmittance(ior, r * std::cos(t)) * std::cos(t);
        for (std::size_t k = 0; k < series.size(); ++k)
            series[k] += (k == 0 ? 1.0 : 2.0) / pi * value * std::cos(kMultiples[k] * t);
    }
    return series;
}

std::array<int, 2> look_ups_of(int terms) {
    return {(3 * kFineTerms + 3) / 4, (3 * (terms - kFineTerms) + 3) / 4};
}

int chart_count(const KernelTable& kernel) {
    return is_even(kernel) ? 1 : 2;
}

glm::dvec3 sample(const CircleMap& map, const ShadingPoint& frame) {
    const glm::dmat3 to_tangent = world_to_tangent(frame);
    const glm::dvec3 v = to_tangent * glm::normalize(frame.view);
    if (v.z <= 0.0) return glm::dvec3(0.0);
    const glm::dmat3 to_world = glm::transpose(to_tangent);
    const bool lower = to_world[0].y < 0.0;
    const double sign = lower && map.charts == 1 ? -1.0 : 1.0;
    const int chart = lower && map.charts == 2 ? 1 : 0;
    const CircleFrame at = frame_at(sign * to_world[0], chart);
    const CirclePosition look_up{chart, chart_point(at.g, chart), sign * v.x};
    const std::array<double, 11> f =
        angle_functions(glm::dot(to_world[2], at.e1), glm::dot(to_world[2], at.e2), map.covered);
    glm::dvec3 sum(0.0);
    for (const CircleLevel& level : map.levels)
        for (int term = 0; term < level.terms; ++term)
            sum += f[static_cast<std::size_t>(level.first_term + term)] * term_at(level, term, look_up);
    return sum;
}

}  // namespace rowland::diffraction
